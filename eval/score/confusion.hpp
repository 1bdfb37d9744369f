// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/truth/surface_truth.hpp"
#include "eval/truth/visible_truth.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// How often what is there (row: a class, background included) was taken for what (column: a class,
/// then any further answers). Integers that add.
class ConfusionMatrix {
 public:
  /// Empty: takes the size of what is pooled into it.
  ConfusionMatrix() = default;
  /// Zeros; `further_columns` answers beside the classes.
  explicit ConfusionMatrix(std::size_t class_count, std::size_t further_columns = 0);

  /// Rows, and columns that are classes.
  [[nodiscard]] std::size_t class_count() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }

  /// Row below class_count(), column below columns().
  [[nodiscard]] std::int64_t at(std::size_t row, std::size_t column) const {
    return cells_[row * columns_ + column];
  }
  void count(std::size_t row, std::size_t column, std::int64_t times = 1) {
    cells_[row * columns_ + column] += times;
  }

  [[nodiscard]] std::int64_t row_sum(std::size_t row) const;
  [[nodiscard]] std::int64_t column_sum(std::size_t column) const;
  /// Sum of the diagonal.
  [[nodiscard]] std::int64_t trace() const;
  [[nodiscard]] std::int64_t total() const;

  /// Pools. Throws Error when sizes differ.
  ConfusionMatrix& operator+=(const ConfusionMatrix& other);
  bool operator==(const ConfusionMatrix&) const = default;

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<std::int64_t> cells_;  ///< row-major
};

/// Columns of a voxel confusion matrix behind the classes: class_count + kUnlabelled, ...
inline constexpr std::size_t kUnlabelled = 0;  ///< in the map, nothing predicted
inline constexpr std::size_t kUnmapped = 1;    ///< not in the map
inline constexpr std::size_t kVoxelAnswers = 2;

/// Where the voxels of V went, and what was predicted where nothing is: every voxel of V_t counts
/// in row t, at the class predicted there or at kUnlabelled or kUnmapped; a predicted voxel of
/// class p outside S_p and in no V counts in row background, column p. Column background stays
/// empty, since it is never predicted. Time is linear in the voxels of map and V. Throws Error when
/// the lattices of S and V differ, or map or V have a class that is not below `class_count`.
/// Thread-safe.
[[nodiscard]] ConfusionMatrix confusion_of(const MapSnapshot& map, double threshold,
                                           const SurfaceTruth& surface, const VisibleTruth& visible,
                                           std::size_t class_count);

}  // namespace mapscore::eval
