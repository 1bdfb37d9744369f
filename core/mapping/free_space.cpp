// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/free_space.hpp"

#include "core/error.hpp"
#include "core/mapping/semantic_octree.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace mapscore {
namespace {

using Point3f = std::array<float, 3>;

/// OctoMap's voxel of a coordinate. It multiplies by the inverse of the edge, which differs from
/// voxel_of within a rounding of a plane.
VoxelKey octomap_voxel(const Point3f& p, double inverse_edge) {
  const auto index = [&](float x) {
    return static_cast<std::int32_t>(std::floor(inverse_edge * x));
  };
  return {index(p[0]), index(p[1]), index(p[2])};
}

Point3f octomap_centre(const VoxelKey& key, double edge_m) {
  const auto centre = [&](std::int32_t index) {
    return static_cast<float>((static_cast<double>(index) + 0.5) * edge_m);
  };
  return {centre(key.i), centre(key.j), centre(key.k)};
}

bool within_span(const Eigen::Vector3d& p, double edge_m) {
  const double reach_m = kOctreeReach * edge_m;
  return (p.array() >= -reach_m).all() && (p.array() < reach_m).all();
}

/// Length of a vector, its square in single precision.
double length_of(const Point3f& way) {
  const float squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  return std::sqrt(static_cast<double>(squared));
}

/// One ray after the other from the same origin. Their traversal is bit for bit that of
/// octomap::OcTreeBaseImpl::computeRayKeys (OctoMap 1.9.7; after Amanatides and Woo, 1987): end
/// points and direction in single precision, distances along the ray summed in doubles; it also
/// stops at the ray's length, should rounding make it miss the last voxel.
class Rays {
 public:
  Rays(const Eigen::Vector3d& origin, double edge_m, std::optional<double> max_range_m)
      : origin_{static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                static_cast<float>(origin.z())},
        edge_m_(edge_m),
        inverse_edge_(1.0 / edge_m),
        max_range_m_(max_range_m),
        first_(octomap_voxel(origin_, inverse_edge_)) {}

  [[nodiscard]] const VoxelKey& first() const { return first_; }

  /// Frees what the ray to the centre of `last`, which is hit, passes; unless that lies beyond the
  /// range, where the ray ends and nothing is hit.
  void cast(const VoxelKey& last, SpaceGrid& grid) const {
    const Point3f centre = octomap_centre(last, edge_m_);
    if (!max_range_m_) return free_to(centre, last, grid);
    const Point3f way = way_to(centre);
    const double length = length_of(way);
    if (length <= *max_range_m_) return free_to(centre, last, grid);
    grid.clear_hit(grid.place_of(last));
    const auto range = static_cast<float>(*max_range_m_);
    Point3f end;
    for (std::size_t n = 0; n < 3; ++n)
      end[n] = origin_[n] + way[n] / static_cast<float>(length) * range;
    free_to(end, octomap_voxel(end, inverse_edge_), grid);
  }

 private:
  [[nodiscard]] Point3f way_to(const Point3f& end) const {
    return {end[0] - origin_[0], end[1] - origin_[1], end[2] - origin_[2]};
  }

  /// Frees every voxel from the first to the one before the last; none if these are equal.
  void free_to(const Point3f& end, const VoxelKey& last, SpaceGrid& grid) const {
    std::ptrdiff_t place = grid.place_of(first_);
    const std::ptrdiff_t end_place = grid.place_of(last);
    if (place == end_place) return;
    const Point3f way = way_to(end);
    const auto length = static_cast<float>(length_of(way));
    const std::array<std::int32_t, 3> cell{first_.i, first_.j, first_.k};
    constexpr double kNever = std::numeric_limits<double>::max();
    std::array<std::ptrdiff_t, 3> move{};  // in the grid, of a step along each axis
    std::array<double, 3> next{kNever, kNever, kNever}, delta = next;  // to the borders, between
    for (std::size_t n = 0; n < 3; ++n) {
      const float direction = way[n] / length;
      const int step = direction > 0.0f ? 1 : direction < 0.0f ? -1 : 0;
      if (step == 0) continue;
      double border = (cell[n] + 0.5) * edge_m_;
      border += static_cast<float>(step * edge_m_ * 0.5);
      next[n] = (border - origin_[n]) / direction;
      delta[n] = edge_m_ / std::fabs(direction);
      move[n] = step * grid.strides()[n];
    }
    double x = next[0], y = next[1], z = next[2];
    for (;;) {
      grid.set_free(place);
      const bool x_first = x < y && x < z;  // ties go to z before y before x
      const bool y_first = !(x < y) && y < z;
      const bool z_first = !x_first && !y_first;
      place += x_first ? move[0] : y_first ? move[1] : move[2];
      x += x_first ? delta[0] : 0.0;
      y += y_first ? delta[1] : 0.0;
      z += z_first ? delta[2] : 0.0;
      if (place == end_place) return;
      const double least = x < y ? (x < z ? x : z) : (y < z ? y : z);
      if (least > length) return;
    }
  }

  Point3f origin_;
  double edge_m_, inverse_edge_;
  std::optional<double> max_range_m_;
  VoxelKey first_;
};

}  // namespace

SeenSpace seen_space(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> points,
                     double edge_m, std::optional<double> max_range_m,
                     std::span<const VoxelKey> also_hit) {
  if (!(edge_m > 0.0) || !std::isfinite(edge_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (max_range_m && !(*max_range_m > 0.0))
    throw Error("max_range_m: must be a positive length in metres");
  if (!within_span(origin, edge_m))
    throw Error("origin: must be finite and within 2^15 voxels of the map's origin");
  const Rays rays(origin, edge_m, max_range_m);
  VoxelBounds bounds{rays.first(), rays.first()};
  SeenSpace seen;
  std::vector<VoxelKey> ends;
  ends.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    if (!within_span(point, edge_m)) {
      ++seen.points_left_out;
      continue;
    }
    const VoxelKey key = voxel_of(point, edge_m);
    if (!ends.empty() && ends.back() == key) continue;
    ends.push_back(key);
    bounds.include(key);
  }
  for (const VoxelKey& key : also_hit)
    if (fits_octree(key)) bounds.include(key);
  bounds.include(rays.first());
  SpaceGrid grid(bounds);
  std::erase_if(ends, [&](const VoxelKey& end) {
    const std::ptrdiff_t place = grid.place_of(end);
    const bool known = grid.is_hit(place);
    grid.set_hit(place);
    return known;
  });
  for (const VoxelKey& end : ends) rays.cast(end, grid);
  for (const VoxelKey& key : also_hit)
    if (fits_octree(key)) grid.set_hit(grid.place_of(key));
  seen.blocks = grid.blocks();
  return seen;
}

}  // namespace mapscore
