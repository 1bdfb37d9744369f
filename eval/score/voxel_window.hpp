// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/voxel.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Voxel of a row; a row may be nothing but its voxel.
template <class Row>
[[nodiscard]] const VoxelKey& key_of(const Row& row) {
  return row.key;
}
[[nodiscard]] inline const VoxelKey& key_of(const VoxelKey& row) {
  return row;
}

/// A look into rows that are sorted by voxel, for voxels that are asked for in the same
/// order: of the voxel itself, or of its surroundings. Every column (i + di, j + dj) has a place of
/// its own in the rows that only moves on, so a walk through all voxels costs a walk through all
/// rows a column, and no look-ups in tables that are far larger than the caches. Not thread-safe.
template <class Row>
class VoxelWindow {
 public:
  /// `reach` >= 0: farthest surroundings that will be asked for, voxels. `rows` is kept by
  /// reference.
  VoxelWindow(std::span<const Row> rows, int reach) : rows_(rows), reach_(reach) {
    for (int di = -reach; di <= reach; ++di) {
      for (int dj = -reach; dj <= reach; ++dj) columns_.push_back({di, dj, 0});
    }
    // Nearer columns first, so that the search for the nearest row soon ends.
    std::stable_sort(columns_.begin(), columns_.end(),
                     [](const Column& a, const Column& b) { return ring(a) < ring(b); });
  }

  /// Rows of the voxel. `key` must not lie before the last one asked for.
  [[nodiscard]] std::span<const Row> at(const VoxelKey& key) {
    advance(here_, key);
    std::size_t last = here_;
    while (last < rows_.size() && key_of(rows_[last]) == key) ++last;
    return rows_.subspan(here_, last - here_);
  }

  /// Chebyshev distance in voxels, 0 to `reach`, from `key` to the nearest row that satisfies
  /// `holds`; reach + 1 when there is none that near. `key` must not lie before the last one asked
  /// for.
  template <class Predicate>
  [[nodiscard]] int distance(const VoxelKey& key, Predicate holds) {
    int least = reach_ + 1;
    for (Column& column : columns_) {
      if (ring(column) >= least) break;
      for_each_in_column(column, key, least - 1, [&](const Row& row) {
        const int away = std::max(ring(column), std::abs(key_of(row).k - key.k));
        if (away < least && holds(row)) least = away;
      });
    }
    return least;
  }

  /// Calls `visit(row)` for all rows within `reach` of `key` on each axis. `key` must not lie
  /// before the last one asked for.
  template <class Visit>
  void for_each_within_reach(const VoxelKey& key, Visit visit) {
    for (Column& column : columns_) for_each_in_column(column, key, reach_, visit);
  }

 private:
  struct Column {
    int di, dj;
    std::size_t first;  ///< no row before it will be asked for again
  };
  [[nodiscard]] static int ring(const Column& column) {
    return std::max(std::abs(column.di), std::abs(column.dj));
  }

  /// Calls `visit(row)` for the rows of a column from `reach` below `key` to `above` over it.
  template <class Visit>
  void for_each_in_column(Column& column, const VoxelKey& key, int above, const Visit& visit) {
    const VoxelKey low{key.i + column.di, key.j + column.dj, key.k - reach_};
    advance(column.first, low);
    for (std::size_t row = column.first; row < rows_.size(); ++row) {
      const VoxelKey& there = key_of(rows_[row]);
      if (there.i != low.i || there.j != low.j || there.k > key.k + above) break;
      visit(rows_[row]);
    }
  }

  /// Moves `place` on to the first row that does not lie before `key`, by steps that double.
  void advance(std::size_t& place, const VoxelKey& key) const {
    std::size_t step = 1;
    while (place + step <= rows_.size() && key_of(rows_[place + step - 1]) < key) {
      place += step;
      step *= 2;
    }
    const auto ahead = rows_.subspan(place, std::min(step, rows_.size() - place));
    const auto first = std::ranges::lower_bound(
        ahead, key, {}, [](const Row& row) -> const VoxelKey& { return key_of(row); });
    place += static_cast<std::size_t>(first - ahead.begin());
  }

  std::span<const Row> rows_;
  int reach_;
  std::size_t here_ = 0;
  std::vector<Column> columns_;
};

/// True when a voxel at Chebyshev distance exactly `t` >= 1 from `key` satisfies `holds(VoxelKey)`.
template <class Predicate>
[[nodiscard]] bool any_in_shell(const VoxelKey& key, int t, Predicate holds) {
  for (int di = -t; di <= t; ++di) {
    for (int dj = -t; dj <= t; ++dj) {
      const bool on_side = di == -t || di == t || dj == -t || dj == t;
      for (int dk = -t; dk <= t; dk += on_side ? 1 : 2 * t) {
        if (holds(VoxelKey{key.i + di, key.j + dj, key.k + dk})) return true;
      }
    }
  }
  return false;
}

}  // namespace mapscore::eval
