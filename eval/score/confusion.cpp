// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/confusion.hpp"

#include "core/error.hpp"
#include "eval/score/map_snapshot.hpp"
#include "eval/score/voxel_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>

namespace mapscore::eval {
namespace {

/// Column of what the map says of one voxel; `voxel` holds it, or nothing.
std::size_t answer_of(std::span<const MapVoxel> voxel, double threshold, std::size_t class_count) {
  if (voxel.empty()) return class_count + kUnmapped;
  return predicted(voxel.front(), threshold) ? voxel.front().best_class : class_count + kUnlabelled;
}

void count_visible(const MapSnapshot& map, double threshold, const VisibleTruth& visible,
                   ConfusionMatrix& matrix) {
  const std::size_t class_count = matrix.class_count();
  for (auto rest = visible.voxels(); !rest.empty();) {  // by owner, then key
    const ClassId owner = rest.front().owner;
    check_class(rest.front().key, owner, class_count);
    const auto of_class = visible.of(owner);
    VoxelWindow<MapVoxel> rows(map.voxels(), 0);
    for (const VisibleVoxel& truth : of_class) {
      matrix.count(owner, answer_of(rows.at(truth.key), threshold, class_count));
    }
    rest = rest.subspan(of_class.size());
  }
}

void count_from_nothing(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                        const VisibleTruth& visible, ConfusionMatrix& matrix) {
  VoxelWindow<SurfaceVoxel> rows(surface.voxels(), 0);
  for (const MapVoxel& voxel : map.voxels()) {
    if (!predicted(voxel, threshold)) continue;
    check_class(voxel.key, voxel.best_class, matrix.class_count());
    const auto here = rows.at(voxel.key);
    const bool is_true = std::any_of(here.begin(), here.end(), [&](const SurfaceVoxel& row) {
      return row.class_id == voxel.best_class;
    });
    if (!is_true && !visible.owner_of(voxel.key)) matrix.count(kBackground, voxel.best_class);
  }
}

}  // namespace

ConfusionMatrix::ConfusionMatrix(std::size_t class_count, std::size_t further_columns)
    : rows_(class_count),
      columns_(class_count + further_columns),
      cells_(class_count * (class_count + further_columns)) {}

std::int64_t ConfusionMatrix::row_sum(std::size_t row) const {
  const auto first = cells_.begin() + static_cast<std::ptrdiff_t>(row * columns_);
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(columns_), std::int64_t{0});
}

std::int64_t ConfusionMatrix::column_sum(std::size_t column) const {
  std::int64_t sum = 0;
  for (std::size_t row = 0; row < rows_; ++row) sum += at(row, column);
  return sum;
}

std::int64_t ConfusionMatrix::trace() const {
  std::int64_t sum = 0;
  for (std::size_t row = 0; row < rows_; ++row) sum += at(row, row);
  return sum;
}

std::int64_t ConfusionMatrix::total() const {
  return std::accumulate(cells_.begin(), cells_.end(), std::int64_t{0});
}

ConfusionMatrix& ConfusionMatrix::operator+=(const ConfusionMatrix& other) {
  if (columns_ == 0) return *this = other;
  if (other.columns_ == 0) return *this;
  if (rows_ != other.rows_ || columns_ != other.columns_) {
    throw Error(
        fmt::format("score: confusion matrices of {} x {} and {} x {} do not add; pool those of "
                    "one class table",
                    rows_, columns_, other.rows_, other.columns_));
  }
  std::transform(cells_.begin(), cells_.end(), other.cells_.begin(), cells_.begin(), std::plus{});
  return *this;
}

ConfusionMatrix confusion_of(const MapSnapshot& map, double threshold, const SurfaceTruth& surface,
                             const VisibleTruth& visible, std::size_t class_count) {
  check_same_lattice(surface, visible);
  ConfusionMatrix matrix(class_count, kVoxelAnswers);
  count_from_nothing(map, threshold, surface, visible, matrix);
  count_visible(map, threshold, visible, matrix);
  return matrix;
}

}  // namespace mapscore::eval
