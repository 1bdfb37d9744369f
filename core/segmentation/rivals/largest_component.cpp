// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/rivals/largest_component.hpp"

#include "core/segmentation/direct.hpp"
#include "core/segmentation/rivals/point_cells.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mapscore {
namespace {

/// Connected components of cells, numbered in the order of their first points.
struct Components {
  std::vector<int> of_cell;
  std::vector<int> sizes;  ///< in points
};

/// Calls act(cell) for the occupied cells among the 26 around `middle`.
void for_neighbours(const PointCells& cells, const VoxelKey& middle, const auto& act) {
  for (int di = -1; di <= 1; ++di)
    for (int dj = -1; dj <= 1; ++dj)
      for (int dk = -1; dk <= 1; ++dk) {
        const int cell = cells.at({middle.i + di, middle.j + dj, middle.k + dk});
        if (cell != PointCells::kNone) act(static_cast<std::size_t>(cell));
      }
}

Components components_of(const PointCells& cells) {
  constexpr int kUnseen = -1;
  Components components;
  components.of_cell.assign(cells.count(), kUnseen);
  std::vector<std::size_t> stack;
  for (std::size_t first = 0; first < cells.count(); ++first) {
    if (components.of_cell[first] != kUnseen) continue;
    const int component = static_cast<int>(components.sizes.size());
    components.sizes.push_back(0);
    components.of_cell[first] = component;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::size_t cell = stack.back();
      stack.pop_back();
      components.sizes.back() += cells.sizes()[cell];
      for_neighbours(cells, cells.key(static_cast<int>(cell)), [&](std::size_t neighbour) {
        if (components.of_cell[neighbour] != kUnseen) return;
        components.of_cell[neighbour] = component;
        stack.push_back(neighbour);
      });
    }
  }
  return components;
}

}  // namespace

Segment LargestComponent::segment(const Detection& detection, const RegisteredCloud& cloud,
                                  double voxel_m, bool with_voxels) const {
  const std::vector<Eigen::Vector3d> points = points_behind(detection.mask, detection.box, cloud);
  const PointCells cells(points, cell_m);
  const Components components = components_of(cells);
  const auto largest = static_cast<int>(std::ranges::max_element(components.sizes) -
                                        components.sizes.begin());  // the first of equal ones
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const int component = components.of_cell[static_cast<std::size_t>(cells.cell_of()[n])];
    const bool enough = components.sizes[static_cast<std::size_t>(component)] >= min_points;
    if (enough && (keep == KeptComponents::all || component == largest)) kept.push_back(points[n]);
  }
  return segment_of(std::move(kept), voxel_m, with_voxels);
}

}  // namespace mapscore
