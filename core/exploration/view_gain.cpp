// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/view_gain.hpp"

#include "core/exploration/space_ray.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mapscore {
namespace {

constexpr double kLeastSine = 0.15;  ///< of a ray that meets the floor
constexpr double kLeastChance = 0.05;

bool is_surface(Space space) {
  return space == Space::occupied || space == Space::unsure;
}

/// Numbers of blocks of 8 x 8 x 8 cubes in a box.
class Blocks {
 public:
  explicit Blocks(const KnownSpace& space) : low_(space.low()) {
    const VoxelKey& size = space.size();
    size_ = {(size.i + 7) / 8, (size.j + 7) / 8, (size.k + 7) / 8};
  }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(size_.i) * static_cast<std::size_t>(size_.j) *
           static_cast<std::size_t>(size_.k);
  }
  [[nodiscard]] std::size_t of(const VoxelKey& cube) const {
    return static_cast<std::size_t>(
        (((cube.i - low_.i) >> 3) * size_.j + ((cube.j - low_.j) >> 3)) * size_.k +
        ((cube.k - low_.k) >> 3));
  }

 private:
  VoxelKey low_, size_;
};

/// One ray's gain.
struct RayGain {
  double unknown = 0.0, unsure = 0.0;
};

}  // namespace

ViewGain::ViewGain(const Calibration& cameras, double ray_step_rad, double heading_step_rad,
                   double surface_per_m)
    : cameras_(cameras),
      surface_per_m_(surface_per_m),
      camera_m_(cameras.T_base_depth.translation().z()) {
  check(cameras);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto headings = static_cast<std::size_t>(std::lround(kTurn / heading_step_rad));
  heading_rays_ = std::max<std::size_t>(
      1,
      static_cast<std::size_t>(std::lround(kTurn / ray_step_rad / static_cast<double>(headings))));
  azimuths_ = headings * heading_rays_;
  ray_step_rad_ = kTurn / static_cast<double>(azimuths_);
  for (std::size_t n = 0; n < azimuths_; ++n) {
    const double azimuth = static_cast<double>(n) * ray_step_rad_;
    directions_.emplace_back(std::cos(azimuth), std::sin(azimuth));
  }
  const auto half = static_cast<int>(std::floor(0.5 * std::numbers::pi / ray_step_rad_));
  for (int n = -half; n <= half; ++n) {
    const double elevation = n * ray_step_rad_;
    Elevation ring{std::sin(elevation),
                   std::cos(elevation),
                   std::cos(elevation) * ray_step_rad_ * ray_step_rad_,
                   {}};
    for (std::size_t a = 0; a < azimuths_; ++a)
      if (in_frustum(
              {ring.cosine * directions_[a].x(), ring.cosine * directions_[a].y(), ring.sine}))
        ring.in_view.push_back(static_cast<std::ptrdiff_t>(a));
    if (!ring.in_view.empty()) elevations_.push_back(std::move(ring));
  }
}

/// Of a direction from the camera, in the axes of the base.
bool ViewGain::in_frustum(const Eigen::Vector3d& p_base) const {
  const Eigen::Vector3d p = cameras_.T_base_depth.linear().transpose() * p_base;
  if (p.z() <= 0.0) return false;
  const CameraModel& camera = cameras_.depth;
  const Eigen::Vector2d pixel = camera.project(p);
  return pixel.x() >= -0.5 && pixel.x() < camera.width_px - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() < camera.height_px - 0.5;
}

std::vector<bool> ViewGain::looked(const Elevation& elevation,
                                   const std::vector<double>& looked_rad) const {
  std::vector<bool> looked(azimuths_, false);
  const auto turn = static_cast<std::ptrdiff_t>(azimuths_);
  for (const double heading_rad : looked_rad) {
    const auto rays = static_cast<std::ptrdiff_t>(std::lround(heading_rad / ray_step_rad_));
    for (const std::ptrdiff_t a : elevation.in_view)
      looked[static_cast<std::size_t>(((rays + a) % turn + turn) % turn)] = true;
  }
  return looked;
}

Panorama ViewGain::look_around(const Scene& scene, const Eigen::Vector2d& place_m,
                               const std::vector<double>& looked_rad) const {
  const Eigen::Vector3d origin(place_m.x(), place_m.y(), scene.floor_m + camera_m_);
  const double per_voxel = 1.0 / (scene.voxel_m * scene.voxel_m);
  const std::int32_t floor = voxel_of({0, 0, scene.floor_m}, scene.space.edge_m()).k;
  Panorama panorama;
  panorama.headings.resize(headings());
  std::vector<RayGain> ring(azimuths_);
  const Blocks blocks(scene.space);
  std::vector<double> of_block(blocks.count(), 0.0);
  for (const Elevation& elevation : elevations_) {
    const std::vector<bool> known = looked(elevation, looked_rad);
    for (std::size_t a = 0; a < azimuths_; ++a) {
      ring[a] = {};
      if (known[a]) continue;
      RayGain gain;
      double chance = 1.0;  // that no surface has been met
      const Eigen::Vector3d direction(elevation.cosine * directions_[a].x(),
                                      elevation.cosine * directions_[a].y(), elevation.sine);
      walk_ray(scene.space, origin, direction, cameras_.range_max_m,
               [&](const VoxelKey& key, Space space, double from_m, double to_m) {
                 if (space == Space::free) return true;
                 const bool measured = from_m >= cameras_.range_min_m;
                 const double area = elevation.solid_angle * from_m * from_m * per_voxel;
                 if (is_surface(space)) {
                   if (space == Space::unsure && measured)
                     gain.unsure += chance * area * static_cast<double>(scene.unsure.of(key));
                   return false;
                 }
                 const auto worth = static_cast<double>(scene.unknown.of(key));
                 const bool on_floor = key.k == floor;
                 const double meets =
                     on_floor ? worth : worth * std::min(1.0, surface_per_m_ * (to_m - from_m));
                 const double slope = on_floor ? std::max(kLeastSine, -elevation.sine) : 1.0;
                 if (measured) {
                   const double expected = chance * meets * area / slope;
                   gain.unknown += expected;
                   of_block[blocks.of(key)] += expected;
                 }
                 chance *= 1.0 - meets;
                 return chance > kLeastChance && !on_floor;
               });
      ring[a] = gain;
      panorama.all.unknown += gain.unknown;
      panorama.all.unsure += gain.unsure;
    }
    for (std::size_t h = 0; h < panorama.headings.size(); ++h)
      for (const std::ptrdiff_t a : elevation.in_view) {
        const RayGain& gain = ring[(h * heading_rays_ + static_cast<std::size_t>(a)) % azimuths_];
        panorama.headings[h].unknown += gain.unknown;
        panorama.headings[h].unsure += gain.unsure;
      }
  }
  for (std::size_t n = 0; n < of_block.size(); ++n)
    if (of_block[n] > 0.0) panorama.blocks.push_back({n, of_block[n]});
  for (const LookAgain& point : scene.again) {
    bool seen = false;
    for (std::size_t h = 0; h < panorama.headings.size(); ++h) {
      const PlanarPose pose{place_m.x(), place_m.y(), static_cast<double>(h) * heading_step_rad()};
      if (!sees(scene.space, pose, scene.floor_m, point.p_map)) continue;
      panorama.headings[h].again += point.priority_voxels;
      seen = true;
    }
    if (seen) panorama.all.again += point.priority_voxels;
  }
  return panorama;
}

bool ViewGain::sees(const KnownSpace& space, const PlanarPose& T_map_base, double floor_m,
                    const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3d origin(T_map_base.x_m, T_map_base.y_m, floor_m + camera_m_);
  const Eigen::Vector3d way = p_map - origin;
  const double distance = way.norm();
  const Eigen::AngleAxisd turn(-T_map_base.yaw_rad, Eigen::Vector3d::UnitZ());
  if (distance < cameras_.range_min_m || distance > cameras_.range_max_m || !in_frustum(turn * way))
    return false;
  const double before = distance - 3.0 * space.edge_m();  // its own surface does not hide it
  bool open = true;
  walk_ray(
      space, origin, way / distance, before,
      [&](const VoxelKey&, Space passed, double, double) { return open = !is_surface(passed); });
  return open;
}

void ViewGain::remember(const KnownSpace& space, const PlanarPose& T_map_base, double floor_m,
                        const std::vector<LookAgain>& again, LookMemory& memory) const {
  const Eigen::Vector3d origin(T_map_base.x_m, T_map_base.y_m, floor_m + camera_m_);
  const Eigen::AngleAxisd turn(T_map_base.yaw_rad, Eigen::Vector3d::UnitZ());
  std::vector<VoxelKey> unknown, unsure, points;
  for (const Elevation& elevation : elevations_)
    for (const std::ptrdiff_t a : elevation.in_view) {
      const Eigen::Vector2d& azimuth = directions_[static_cast<std::size_t>(a)];
      const Eigen::Vector3d direction(elevation.cosine * azimuth.x(),
                                      elevation.cosine * azimuth.y(), elevation.sine);
      walk_ray(space, origin, turn * direction, cameras_.range_max_m,
               [&](const VoxelKey& key, Space passed, double, double) {
                 if (passed == Space::unknown) unknown.push_back(LookMemory::block_of(key));
                 if (passed == Space::unsure) unsure.push_back(LookMemory::block_of(key));
                 return !is_surface(passed);
               });
    }
  for (const LookAgain& point : again)
    if (sees(space, T_map_base, floor_m, point.p_map))
      points.push_back(LookMemory::block_of(voxel_of(point.p_map, space.edge_m())));
  memory.add(Looked::unknown, std::move(unknown));
  memory.add(Looked::unsure, std::move(unsure));
  memory.add(Looked::again, std::move(points));
}

}  // namespace mapscore
