// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/objects/solid_piece.hpp"

#include "core/error.hpp"
#include "core/geometry/voxel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mapscore {
namespace {

/// Pieces of the cells, ascending and different: a number for each, 0 up.
std::vector<std::size_t> pieces_of(const std::vector<VoxelKey>& cells) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> piece(cells.size(), kNone), open;
  std::size_t count = 0;
  for (std::size_t start = 0; start < cells.size(); ++start) {
    if (piece[start] != kNone) continue;
    piece[start] = count;
    open.assign(1, start);
    while (!open.empty()) {
      const VoxelKey at = cells[open.back()];
      open.pop_back();
      for (std::int32_t i = at.i - 1; i <= at.i + 1; ++i) {
        for (std::int32_t j = at.j - 1; j <= at.j + 1; ++j) {
          // the up to three cells of a column stand side by side
          auto next = std::ranges::lower_bound(cells, VoxelKey{i, j, at.k - 1});
          const VoxelKey last{i, j, at.k + 1};
          for (; next != cells.end() && *next <= last; ++next) {
            const auto n = static_cast<std::size_t>(next - cells.begin());
            if (piece[n] != kNone) continue;
            piece[n] = count;
            open.push_back(n);
          }
        }
      }
    }
    ++count;
  }
  return piece;
}

}  // namespace

std::vector<Eigen::Vector3d> largest_solid_piece(const std::vector<Eigen::Vector3d>& points,
                                                 double cell_m) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m))
    throw Error("cell_m: must be a positive length in metres");
  if (points.empty()) return {};
  std::vector<VoxelKey> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3d& p : points) cells.push_back(voxel_of(p, cell_m));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const std::vector<std::size_t> piece_of_cell = pieces_of(cells);
  std::vector<std::size_t> piece;  // of each point
  std::vector<std::size_t> size(cells.size());
  for (const Eigen::Vector3d& p : points) {
    const auto at = std::ranges::lower_bound(cells, voxel_of(p, cell_m));
    piece.push_back(piece_of_cell[static_cast<std::size_t>(at - cells.begin())]);
    ++size[piece.back()];
  }
  const std::size_t kept =
      *std::ranges::max_element(piece, {}, [&](std::size_t n) { return size[n]; });
  std::vector<Eigen::Vector3d> solid;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (piece[n] == kept) solid.push_back(points[n]);
  return solid;
}

}  // namespace mapscore
