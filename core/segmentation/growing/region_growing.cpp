// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/growing/region_growing.hpp"

#include "core/error.hpp"
#include "core/segmentation/direct.hpp"
#include "core/segmentation/growing/growing_workspace.hpp"
#include "core/segmentation/growing/lattice_bits.hpp"
#include "core/segmentation/growing/point_extent.hpp"
#include "core/segmentation/growing/reached_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace mapscore {
namespace {

/// Above this many lattice positions (64 MB) the points lie too far apart for a dense grid.
constexpr double kMostPositions = 1 << 26;

/// Grows over finite points. Indices here are relative to the grid's low corner. The products with
/// the inverse pitch only choose which positions are tested, with slack for all rounding; the test
/// itself is the plain form's.
template <class Scalar>
class FastGrowing {
 public:
  FastGrowing(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed, double pitch_m,
              double factor)
      : points_(points),
        seed_(seed),
        pitch_m_(pitch_m),
        factor_(factor),
        radius_squared_(static_cast<Scalar>(factor * pitch_m * (factor * pitch_m))) {}

  /// False when the points do not fit a dense grid; nothing can be grown then.
  [[nodiscard]] bool lay_grid(const PointExtent& extent) {
    const double widest_m = std::max(
        {extent.low.abs().maxCoeff(), extent.high.abs().maxCoeff(), seed_.cwiseAbs().maxCoeff()});
    const double slack =
        1e-9 + 8.0 * std::numeric_limits<Scalar>::epsilon() * (widest_m / pitch_m_ + factor_);
    reach_ = factor_ + slack;
    const Eigen::Array3d low = ((extent.low - seed_.array()) / pitch_m_ - reach_).floor() - 1.0;
    const Eigen::Array3d high = ((extent.high - seed_.array()) / pitch_m_ + reach_).ceil() + 1.0;
    const Eigen::Array3d size = high - low + 1.0, padded = size + Eigen::Array3d(2.0, 2.0, 65.0);
    if (padded.prod() > kMostPositions || !(low.abs() < 1e9).all() || slack > 1.0) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      low_[axis] = static_cast<std::int32_t>(low[a]);
      size_[axis] = static_cast<std::int32_t>(size[a]);
    }
    tabulate_positions();
    return true;
  }

  [[nodiscard]] Region grow() {
    work_.occupied.lay(low_, size_);
    work_.accepted.lay(low_, size_);
    work_.marked.clear();
    work_.spread.clear();
    work_.cube_of.resize(points_.size());
    if (reach_ < kNearestAlone)
      mark_nearest();
    else
      mark_cubes();
    for (const std::size_t n : work_.spread)
      for_each_reached(n, [&](Address a) { return work_.occupied.set(a), false; });
    Region region;
    const std::size_t accepted = flood();
    if (accepted != 0) {
      region.positions.reserve(accepted);
      work_.accepted.for_each([&](const VoxelKey& key) { region.positions.push_back(key); });
      keep_points(region);
    }
    GrowingWorkspace::give_back(std::move(work_));
    return region;
  }

 private:
  using Address = LatticeBits::Address;
  using Index3 = std::array<std::int32_t, 3>;

  /// The point in units of the pitch from the grid's low corner, at least `reach_` + 1 on every
  /// axis.
  struct LatticePoint {
    std::array<double, 3> q;
    std::array<Scalar, 3> p;
  };

  void tabulate_positions() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      coordinates_[axis].resize(static_cast<std::size_t>(size_[axis]));
      for (std::int32_t n = 0; n < size_[axis]; ++n) {
        const VoxelKey key{low_[0] + n, low_[1] + n, low_[2] + n};
        coordinates_[axis][static_cast<std::size_t>(n)] = static_cast<Scalar>(
            lattice_position(seed_, pitch_m_, key)[static_cast<Eigen::Index>(axis)]);
      }
    }
  }

  [[nodiscard]] LatticePoint on_lattice(const Eigen::Vector3d& p) const {
    const double inverse = 1.0 / pitch_m_;
    LatticePoint result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = p[static_cast<Eigen::Index>(axis)];
      result.q[axis] = (x - seed_[static_cast<Eigen::Index>(axis)]) * inverse - low_[axis];
      result.p[axis] = static_cast<Scalar>(x);
    }
    return result;
  }

  /// (x - p)^2 along one axis.
  [[nodiscard]] Scalar squared(const LatticePoint& point, std::size_t axis, std::int32_t n) const {
    const Scalar difference = coordinates_[axis][static_cast<std::size_t>(n)] - point.p[axis];
    return difference * difference;
  }

  [[nodiscard]] bool reaches(const Index3& at, const LatticePoint& point) const {
    return squared(point, 0, at[0]) + squared(point, 1, at[1]) + squared(point, 2, at[2]) <
           radius_squared_;
  }

  [[nodiscard]] Address address(const Index3& at) const {
    return work_.occupied.address(at[0], at[1], at[2]);
  }

  /// Limits, included, of the positions that may be within reach. Truncation rounds down here.
  [[nodiscard]] std::pair<Index3, Index3> block(const LatticePoint& point) const {
    std::pair<Index3, Index3> limits;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      limits.first[axis] = static_cast<std::int32_t>(point.q[axis] - reach_) + 1;
      limits.second[axis] = static_cast<std::int32_t>(point.q[axis] + reach_);
    }
    return limits;
  }

  /// Marks the nearest position of each point that reaches it.
  void mark_nearest() {
    find_nearest_positions(points_, lattice_box(), radius_squared_, work_.cube_of.data());
    for (std::size_t n = 0; n < points_.size(); ++n) {
      if (work_.cube_of[n] == kManyCubes)
        work_.spread.push_back(n);
      else
        work_.occupied.set(work_.cube_of[n]);
    }
    work_.occupied.clear(kNoCube);
  }

  /// Gathers per cube of 2 x 2 x 2 positions which of them are reached by its points, and marks
  /// those.
  void mark_cubes() {
    constexpr std::size_t kMost = 1024;  // points at a time, which stay in the cache
    std::array<std::uint8_t, kMost> corners;
    const LatticeBox box = lattice_box();
    if (work_.cubes.size() < work_.occupied.addresses())
      work_.cubes.resize(work_.occupied.addresses(), 0);
    work_.marked.resize(points_.size());
    std::size_t marked = 0;  // no branches here: which cubes are new is hard to foresee
    for (std::size_t first = 0; first < points_.size(); first += kMost) {
      const std::size_t count = std::min(kMost, points_.size() - first);
      find_reached_corners(points_.subspan(first, count), box, radius_squared_,
                           &work_.cube_of[first], corners.data());
      for (std::size_t n = 0; n < count; ++n) {
        const Address cube = work_.cube_of[first + n];
        if (cube == kManyCubes) work_.spread.push_back(first + n);
        if (cube == kManyCubes) continue;
        std::uint8_t& known = work_.cubes[cube];
        work_.marked[marked] = cube;
        marked += known == 0 && cube != kNoCube;
        known = static_cast<std::uint8_t>(known | corners[n]);
      }
    }
    work_.marked.resize(marked);
    for (const Address cube : work_.marked) work_.occupied.set_corners(cube, work_.cubes[cube]);
  }

  /// Calls `visit(address)` for the positions within reach of a point until it returns true;
  /// whether it did.
  template <class Visit>
  bool for_each_reached(std::size_t n, const Visit& visit) const {
    const LatticePoint point = on_lattice(points_[n]);
    const auto [first, last] = block(point);
    for (std::int32_t i = first[0]; i <= last[0]; ++i)
      for (std::int32_t j = first[1]; j <= last[1]; ++j)
        for (std::int32_t k = first[2]; k <= last[2]; ++k)
          if (reaches({i, j, k}, point) && visit(address({i, j, k}))) return true;
    return false;
  }

  [[nodiscard]] LatticeBox lattice_box() const {
    LatticeBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.seed[axis] = seed_[static_cast<Eigen::Index>(axis)];
      box.low[axis] = low_[axis];
    }
    box.pitch_m = pitch_m_;
    box.reach = reach_;
    box.stride = {work_.occupied.address(1, 0, 0) - work_.occupied.address(0, 0, 0),
                  work_.occupied.address(0, 1, 0) - work_.occupied.address(0, 0, 0)};
    return box;
  }

  /// Moves the piece that holds the seed's position from occupied to accepted; its size.
  std::size_t flood() {
    const Index3 seed{-low_[0], -low_[1], -low_[2]};
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside = inside && seed[axis] >= 0 && seed[axis] < size_[axis];
    if (!inside || !work_.occupied.test(address(seed))) return 0;
    return work_.occupied.move_piece(address(seed), work_.accepted);
  }

  void keep_points(Region& region) {
    constexpr Address kAccepted = kNoCube + 1;  // both lie in the margin
    for (const std::size_t n : work_.spread) {
      const bool kept = for_each_reached(n, [&](Address a) { return work_.accepted.test(a); });
      work_.cube_of[n] = kept ? kAccepted : kNoCube;
    }
    work_.accepted.set(kAccepted);
    if (reach_ < kNearestAlone) {
      keep_if(region, [&](Address a) { return work_.accepted.test(a); });
      return;
    }
    // The marked corners of a cube are neighbours and end in the same piece, so one stands for all,
    // and the cube for its points.
    for (const Address cube : work_.marked)
      work_.cubes[cube] =
          work_.accepted.test(work_.occupied.lowest_corner(cube, work_.cubes[cube])) ? 1 : 0;
    work_.cubes[kAccepted] = 1;
    keep_if(region, [&](Address a) { return work_.cubes[a] != 0; });
    work_.cubes[kAccepted] = 0;
  }

  template <class Keep>
  void keep_if(Region& region, const Keep& keep) const {
    std::size_t kept = 0;  // no branches here: which points are kept is hard to foresee
    region.points.resize(points_.size());
    for (std::size_t n = 0; n < points_.size(); ++n) {
      region.points[kept] = static_cast<int>(n);
      kept += keep(work_.cube_of[n]);
    }
    region.points.resize(kept);
  }

  std::span<const Eigen::Vector3d> points_;
  Eigen::Vector3d seed_;
  double pitch_m_, factor_;
  Scalar radius_squared_;
  double reach_ = 0.0;  ///< search radius in pitches, with slack
  Index3 low_{}, size_{};
  std::array<std::vector<Scalar>, 3> coordinates_;  ///< of the positions, along each axis
  GrowingWorkspace work_ = GrowingWorkspace::take();
};

template <class Scalar>
Region grow_finite(std::span<const Eigen::Vector3d> points, const PointExtent& extent,
                   const Eigen::Vector3d& seed, double pitch_m, double factor) {
  FastGrowing<Scalar> growing(points, seed, pitch_m, factor);
  constexpr bool kReleased = std::is_same_v<Scalar, float>;
  return growing.lay_grid(extent) ? growing.grow()
                                  : grow_region_reference(points, seed, pitch_m, factor, kReleased);
}

/// Without the points that are not finite; indices as in the full list.
Region grow_without_gaps(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed,
                         double pitch_m, double factor, bool released) {
  std::vector<Eigen::Vector3d> finite;
  std::vector<int> indices;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!points[n].allFinite()) continue;
    finite.push_back(points[n]);
    indices.push_back(static_cast<int>(n));
  }
  Region region = grow_region(finite, seed, pitch_m, factor, released);
  for (int& point : region.points) point = indices[static_cast<std::size_t>(point)];
  return region;
}

}  // namespace

Region grow_region(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed,
                   double pitch_m, double factor, bool released) {
  if (!(pitch_m > 0.0) || !std::isfinite(pitch_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (!(factor > 0.0) || !std::isfinite(factor))
    throw Error("search radius: must be a positive multiple of the voxel edge");
  if (points.empty() || !seed.allFinite()) return {};
  const PointExtent extent = extent_of(points);
  if (!extent.finite) return grow_without_gaps(points, seed, pitch_m, factor, released);
  return released ? grow_finite<float>(points, extent, seed, pitch_m, factor)
                  : grow_finite<double>(points, extent, seed, pitch_m, factor);
}

Segment RegionGrowing::segment(const Detection& detection, const RegisteredCloud& cloud,
                               double voxel_m, bool with_voxels) const {
  const std::vector<Eigen::Vector3d> points = points_behind(detection.mask, detection.box, cloud);
  const auto start = seed_point(detection, cloud, seed);
  if (points.empty() || !start)
    return Segment::nothing(points.empty() ? SkipReason::no_points : SkipReason::no_seed_point);
  const auto grow = kd_tree ? grow_region_reference : grow_region;
  const Region region = grow(points, *start, voxel_m, radius_factor, released);
  Segment segment;
  if (region.points.empty()) segment.skipped = SkipReason::seed_off_object;
  segment.points.reserve(region.points.size());
  for (const int index : region.points)
    segment.points.push_back(points[static_cast<std::size_t>(index)]);
  if (with_voxels)
    for (const VoxelKey& key : region.positions)
      segment.voxel_centres.push_back(lattice_position(*start, voxel_m, key));
  return segment;
}

}  // namespace mapscore
