// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/lab/map_frame.hpp"
#include "eval/recording/recording.hpp"
#include "eval/score/distances/distance_score.hpp"
#include "eval/truth/moving_surface.hpp"
#include "eval/truth/surface_truth.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Drawn surfaces in the world frame, and where those that move were at each depth image.
struct RecordedShapes {
  std::vector<Shape> shapes;
  ShapePoses poses;  ///< empty where nothing moves

  /// All shapes at a time: as at the depth image nearest to it. Throws Error when they move and no
  /// time within the recording is given.
  [[nodiscard]] std::vector<Shape> at(std::optional<double> at_s) const;
  /// Position in `poses`; throws as `at`. Needs moving shapes.
  [[nodiscard]] std::size_t image_at(std::optional<double> at_s) const;
};

[[nodiscard]] RecordedShapes shapes_of(const Recording& recording);

/// Surfaces at one instant on one lattice; copies share what they hold.
struct SurfacesAt {
  SurfaceTruth surface;
  CubeDistance distance_to_class;
  CubeDistance distance_to_thin;  ///< to the class's thin geoms alone
};

/// Surfaces that do not move; works on `jobs` threads.
[[nodiscard]] SurfacesAt surfaces_of(const std::vector<Shape>& shapes, const ClassTable& table,
                                     const MapFrame& map_frame, double epsilon_m, int jobs);

/// The surfaces of a recording on one lattice. What stays is voxelised once, what moves at each
/// time that is asked for. Immutable, safe to share between threads.
class RecordedSurfaces {
 public:
  /// `shapes` and `table` must outlive this. Works on `jobs` threads.
  RecordedSurfaces(const RecordedShapes& shapes, const ClassTable& table, const MapFrame& map_frame,
                   double epsilon_m, int jobs);

  /// Throws Error as RecordedShapes::at.
  [[nodiscard]] SurfacesAt at(std::optional<double> at_s) const;

 private:
  const RecordedShapes& shapes_;
  const ClassTable& table_;
  MapFrame map_frame_;
  std::unique_ptr<const MovingSurface> moving_;  ///< none where nothing moves
  ClassDistances fixed_distances_;
  SurfacesAt still_;  ///< where nothing moves
};

}  // namespace mapscore::eval
