// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>

namespace mapscore::eval {

/// How often what is there (row: a class, background included) was taken for what (column: a class,
/// then any further answers). Integers that add.
class ConfusionMatrix {
 public:
  /// Empty: takes the size of what is pooled into it.
  ConfusionMatrix() = default;
  /// Zeros; `further_columns` answers beside the classes.
  explicit ConfusionMatrix(std::size_t class_count, std::size_t further_columns = 0)
      : cells_(Cells::Zero(static_cast<Eigen::Index>(class_count),
                           static_cast<Eigen::Index>(class_count + further_columns))) {}

  /// Rows, and columns that are classes.
  [[nodiscard]] std::size_t class_count() const { return static_cast<std::size_t>(cells_.rows()); }
  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(cells_.cols()); }

  /// Row below class_count(), column below columns().
  [[nodiscard]] std::int64_t at(std::size_t row, std::size_t column) const {
    return cells_(row, column);
  }
  void count(std::size_t row, std::size_t column, std::int64_t times = 1) {
    cells_(row, column) += times;
  }

  [[nodiscard]] std::int64_t row_sum(std::size_t row) const { return cells_.row(row).sum(); }
  [[nodiscard]] std::int64_t column_sum(std::size_t column) const {
    return cells_.col(column).sum();
  }
  /// Sum of the diagonal.
  [[nodiscard]] std::int64_t trace() const { return cells_.diagonal().sum(); }
  [[nodiscard]] std::int64_t total() const { return cells_.sum(); }

  /// Pools. Throws Error when sizes differ.
  ConfusionMatrix& operator+=(const ConfusionMatrix& other) {
    if (columns() == 0) return *this = other;
    if (other.columns() == 0) return *this;
    if (size() != other.size()) {
      throw Error("score: confusion matrices of " + size() + " and " + other.size() +
                  " do not add; pool those of one class table");
    }
    cells_ += other.cells_;
    return *this;
  }
  bool operator==(const ConfusionMatrix& other) const {
    return size() == other.size() && cells_ == other.cells_;
  }

 private:
  using Cells = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

  [[nodiscard]] std::string size() const {
    return std::to_string(class_count()) + " x " + std::to_string(columns());
  }

  Cells cells_;
};

}  // namespace mapscore::eval
