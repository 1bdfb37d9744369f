// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "core/exploration/known_space.hpp"
#include "core/exploration/look_memory.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mapscore {

/// What a view is expected to show, in voxels of surface.
struct Gain {
  double unknown = 0.0;  ///< surface that is in no voxel yet
  double unsure = 0.0;   ///< surface whose class is uncertain
  double again = 0.0;    ///< priorities of the points to be looked at again

  [[nodiscard]] double worth(double unsure_weight) const {
    return unknown + unsure_weight * unsure + again;
  }
};

/// Unknown surface that is expected in a block of 8 x 8 x 8 cubes.
struct BlockGain {
  std::size_t block;  ///< numbered in the space's box
  double unknown;
};

/// The gain of one place: all around, and of each heading.
struct Panorama {
  Gain all;
  std::vector<BlockGain> blocks;  ///< of all.unknown; by block
  std::vector<Gain> headings;     ///< at n * heading_step_rad() in frame map
};

/// Expected gain of views (docs/exploration.md). From a place, rays go out all around and as far up
/// and down as the depth camera sees, every few degrees, each for a solid angle. A ray passes free
/// space and ends at an occupied voxel. In unknown space it meets a surface at a rate per metre; of
/// a ray that meets one at distance d, with solid angle w, the view is expected to show w d^2 / r^2
/// voxels of edge r; at the floor, which is where the robot drives, divided by the sine of the
/// angle of incidence, 0.15 at least. Nearer than the camera's least range nothing counts.
/// Immutable, safe to share between threads.
class ViewGain {
 public:
  /// Angles in radians; the heading step becomes a multiple of the ray step. Throws Error as
  /// check(Calibration).
  ViewGain(const Calibration& cameras, double ray_step_rad, double heading_step_rad,
           double surface_per_m);

  /// What is asked about, which stays as it is: references must stay valid.
  struct Scene {
    const KnownSpace& space;
    double voxel_m, floor_m;
    LookMemory::Worths unknown, unsure;
    std::vector<LookAgain> again;  ///< priorities already times their worth
  };
  /// `looked_rad`: headings of the views that were taken there. What they had in view is worth
  /// nothing: the camera would show the same once more.
  [[nodiscard]] Panorama look_around(const Scene& scene, const Eigen::Vector2d& place_m,
                                     const std::vector<double>& looked_rad = {}) const;

  /// What a view at a pose looks at and leaves unsettled; for LookMemory.
  void remember(const KnownSpace& space, const PlanarPose& T_map_base, double floor_m,
                const std::vector<LookAgain>& again, LookMemory& memory) const;

  [[nodiscard]] double heading_step_rad() const { return heading_rays_ * ray_step_rad_; }
  [[nodiscard]] std::size_t headings() const { return azimuths_ / heading_rays_; }

 private:
  struct Elevation {
    double sine, cosine, solid_angle;
    /// Rays in view on each side of the heading, where the camera does not look sideways.
    std::vector<std::ptrdiff_t> in_view;
  };
  /// Of each azimuth, whether one of the headings had it in view.
  [[nodiscard]] std::vector<bool> looked(const Elevation& elevation,
                                         const std::vector<double>& looked_rad) const;
  [[nodiscard]] bool in_frustum(const Eigen::Vector3d& p_base) const;
  [[nodiscard]] bool sees(const KnownSpace& space, const PlanarPose& T_map_base, double floor_m,
                          const Eigen::Vector3d& p_map) const;

  Calibration cameras_;
  double ray_step_rad_, surface_per_m_, camera_m_;
  std::size_t azimuths_, heading_rays_;
  std::vector<Eigen::Vector2d> directions_;  ///< of the azimuths
  std::vector<Elevation> elevations_;
};

}  // namespace mapscore
