// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/region_growing.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mapscore {
namespace {

/// Above this many lattice cells the points lie too far apart for a dense grid.
constexpr std::int64_t kMostCells = std::int64_t{1} << 24;

/// Inclusive range of lattice indices on each axis.
struct IndexBox {
  std::array<std::int32_t, 3> low, high;
};

template <class Scalar>
class FastGrowing {
 public:
  FastGrowing(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed, double pitch_m,
              double radius_factor)
      : points_(points), seed_(seed), pitch_m_(pitch_m), factor_(radius_factor) {
    const double radius_m = radius_factor * pitch_m;
    radius_squared_ = static_cast<Scalar>(radius_m * radius_m);
  }

  /// False when the points do not fit a dense grid; nothing was grown then.
  [[nodiscard]] bool lay_grid() {
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d high = -low;
    for (const Eigen::Vector3d& p : points_) {
      if (!p.allFinite()) continue;
      low = low.min(p.array());
      high = high.max(p.array());
    }
    if (!(low <= high).all()) return true;  // no points: the grid stays empty
    widest_ = std::max({low.abs().maxCoeff(), high.abs().maxCoeff(), seed_.cwiseAbs().maxCoeff()});
    slack_ = slack();
    const Eigen::Array3d first = ((low - seed_.array()) / pitch_m_ - factor_ - slack_).floor();
    const Eigen::Array3d last = ((high - seed_.array()) / pitch_m_ + factor_ + slack_).ceil();
    const Eigen::Array3d extent = last - first + 1.0;
    if (extent.prod() > static_cast<double>(kMostCells) || first.abs().maxCoeff() > 1e9 ||
        last.abs().maxCoeff() > 1e9)
      return false;
    for (int axis = 0; axis < 3; ++axis) {
      first_[axis] = static_cast<std::int32_t>(first[axis]);
      extent_[axis] = static_cast<std::int32_t>(extent[axis]);
    }
    cells_.assign(static_cast<std::size_t>(extent.prod()), kEmpty);
    return true;
  }

  [[nodiscard]] Region grow() {
    Region region;
    if (cells_.empty()) return region;
    mark_occupied();
    flood(region);
    keep_points(region);
    return region;
  }

 private:
  enum Cell : std::uint8_t { kEmpty, kOccupied, kAccepted };

  /// Bound, in cells, on how far rounding can move a point against the lattice.
  [[nodiscard]] double slack() const {
    return 1e-9 + 8.0 * std::numeric_limits<Scalar>::epsilon() * widest_ / pitch_m_;
  }

  [[nodiscard]] IndexBox candidates(const Eigen::Vector3d& p) const {
    IndexBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const double q = (p[axis] - seed_[axis]) / pitch_m_;
      box.low[axis] = static_cast<std::int32_t>(std::ceil(q - factor_ - slack_));
      box.high[axis] = static_cast<std::int32_t>(std::floor(q + factor_ + slack_));
    }
    return box;
  }

  [[nodiscard]] std::size_t index(std::int32_t i, std::int32_t j, std::int32_t k) const {
    return (static_cast<std::size_t>(i - first_[0]) * static_cast<std::size_t>(extent_[1]) +
            static_cast<std::size_t>(j - first_[1])) *
               static_cast<std::size_t>(extent_[2]) +
           static_cast<std::size_t>(k - first_[2]);
  }

  [[nodiscard]] bool within_reach(const Eigen::Vector3d& p, const VoxelKey& key) const {
    const Eigen::Vector3d position = lattice_position(seed_, pitch_m_, key);
    const Scalar dx = static_cast<Scalar>(position.x()) - static_cast<Scalar>(p.x());
    const Scalar dy = static_cast<Scalar>(position.y()) - static_cast<Scalar>(p.y());
    const Scalar dz = static_cast<Scalar>(position.z()) - static_cast<Scalar>(p.z());
    return dx * dx + dy * dy + dz * dz < radius_squared_;
  }

  /// Calls `visit(cell, key)` for the positions that may reach p until it returns true.
  template <class Visit>
  bool any_candidate(const Eigen::Vector3d& p, const Visit& visit) const {
    const IndexBox box = candidates(p);
    for (std::int32_t i = box.low[0]; i <= box.high[0]; ++i)
      for (std::int32_t j = box.low[1]; j <= box.high[1]; ++j)
        for (std::int32_t k = box.low[2]; k <= box.high[2]; ++k)
          if (visit(index(i, j, k), VoxelKey{i, j, k})) return true;
    return false;
  }

  void mark_occupied() {
    for (const Eigen::Vector3d& p : points_) {
      if (!p.allFinite()) continue;
      any_candidate(p, [&](std::size_t cell, const VoxelKey& key) {
        if (cells_[cell] == kEmpty && within_reach(p, key)) cells_[cell] = kOccupied;
        return false;
      });
    }
  }

  [[nodiscard]] bool inside(const VoxelKey& key) const {
    const std::array<std::int32_t, 3> at{key.i, key.j, key.k};
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < first_[axis] || at[axis] >= first_[axis] + extent_[axis]) return false;
    return true;
  }

  void accept(const VoxelKey& key, std::vector<VoxelKey>& positions) {
    if (!inside(key)) return;
    std::uint8_t& cell = cells_[index(key.i, key.j, key.k)];
    if (cell != kOccupied) return;
    cell = kAccepted;
    positions.push_back(key);
  }

  void flood(Region& region) {
    accept({0, 0, 0}, region.positions);
    for (std::size_t next = 0; next < region.positions.size(); ++next) {
      const VoxelKey key = region.positions[next];
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj)
          for (int dk = -1; dk <= 1; ++dk)
            accept({key.i + di, key.j + dj, key.k + dk}, region.positions);
    }
    std::sort(region.positions.begin(), region.positions.end());
  }

  void keep_points(Region& region) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d& p = points_[i];
      const bool kept =
          p.allFinite() && any_candidate(p, [&](std::size_t cell, const VoxelKey& key) {
            return cells_[cell] == kAccepted && within_reach(p, key);
          });
      if (kept) region.points.push_back(static_cast<int>(i));
    }
  }

  std::span<const Eigen::Vector3d> points_;
  Eigen::Vector3d seed_;
  double pitch_m_, factor_;
  Scalar radius_squared_;
  double widest_ = 0.0, slack_ = 0.0;
  std::array<std::int32_t, 3> first_{}, extent_{};
  std::vector<std::uint8_t> cells_;
};

template <class Scalar>
Region grow_fast(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed,
                 double pitch_m, double radius_factor, bool released) {
  FastGrowing<Scalar> growing(points, seed, pitch_m, radius_factor);
  return growing.lay_grid() ? growing.grow()
                            : grow_region_reference(points, seed, pitch_m, radius_factor, released);
}

}  // namespace

Region grow_region(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& seed,
                   double pitch_m, double radius_factor, bool released) {
  if (!(pitch_m > 0.0) || !std::isfinite(pitch_m))
    throw Error("voxel_m: must be a positive length in metres");
  if (!(radius_factor > 0.0) || !std::isfinite(radius_factor))
    throw Error("radius_factor: must be positive; 1 is the paper's, 0.5 the released code's");
  if (!seed.allFinite()) return {};
  return released ? grow_fast<float>(points, seed, pitch_m, radius_factor, released)
                  : grow_fast<double>(points, seed, pitch_m, radius_factor, released);
}

}  // namespace mapscore
