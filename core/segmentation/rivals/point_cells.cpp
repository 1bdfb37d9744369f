// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/point_cells.hpp"

namespace mapscore {

PointCells::PointCells(std::span<const Eigen::Vector3d> points, double edge_m) {
  cell_of_.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const VoxelKey key = packable_voxel_of(point, edge_m).value();
    // Neighbouring points mostly share a cell.
    const bool as_before = !cell_of_.empty() && this->key(cell_of_.back()) == key;
    const int cell = as_before
                         ? cell_of_.back()
                         : number_.try_emplace(key, static_cast<int>(cells_.size())).first->second;
    if (static_cast<std::size_t>(cell) == cells_.size()) {
      cells_.push_back(key);
      sizes_.push_back(0);
    }
    cell_of_.push_back(cell);
    ++sizes_[static_cast<std::size_t>(cell)];
  }
}

}  // namespace mapscore
