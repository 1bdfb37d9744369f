// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

namespace mapscore {

/// Points sorted into the cells of a lattice anchored at their frame's origin (voxel.hpp). Cells
/// are numbered in the order of their first points, so that no result depends on a hash table.
class PointCells {
 public:
  static constexpr int kNone = -1;

  /// `edge_m`: edge of a cell, positive. Points are finite.
  PointCells(std::span<const Eigen::Vector3d> points, double edge_m);

  [[nodiscard]] std::size_t count() const { return cells_.size(); }
  /// The number of the cell of each point.
  [[nodiscard]] const std::vector<int>& cell_of() const { return cell_of_; }
  /// How many points each cell holds.
  [[nodiscard]] const std::vector<int>& sizes() const { return sizes_; }
  [[nodiscard]] const VoxelKey& key(int cell) const {
    return cells_[static_cast<std::size_t>(cell)];
  }
  /// The number of the occupied cell at `key`, or kNone.
  [[nodiscard]] int at(const VoxelKey& key) const {
    const auto found = number_.find(key);
    return found == number_.end() ? kNone : found->second;
  }

 private:
  std::vector<VoxelKey> cells_;
  std::vector<int> cell_of_, sizes_;
  std::unordered_map<VoxelKey, int> number_;
};

}  // namespace mapscore
