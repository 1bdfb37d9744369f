// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/localization/distance_transform.hpp"

#include <cstddef>

namespace mapscore {
namespace {

/// One line at a time: f(q) becomes min over p of f(p) + (q - p)^2.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t length) : foot_(length), height_(length), from_(length) {}

  /// `line` holds every stride-th value from `first`.
  void transform(std::int64_t* first, std::size_t length, std::size_t stride) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < length; ++q) {
      if (first[q * stride] == kNoObstacle) continue;
      count = add(static_cast<std::int64_t>(q), first[q * stride], count);
    }
    if (count == 0) return;
    std::size_t k = 0;
    for (std::size_t q = 0; q < length; ++q) {
      while (k + 1 < count && from_[k + 1] < static_cast<double>(q)) ++k;
      const std::int64_t d = static_cast<std::int64_t>(q) - foot_[k];
      first[q * stride] = height_[k] + d * d;
    }
  }

 private:
  /// Adds the parabola with foot q and removes those that it hides. A crossing is the correctly
  /// rounded quotient of whole numbers below 2^53, so it falls on the right side of every cell, and
  /// on a cell only when the two parabolas are equal there.
  std::size_t add(std::int64_t q, std::int64_t height, std::size_t count) {
    double from = -1.0;
    for (; count > 0; --count) {
      const std::int64_t p = foot_[count - 1];
      from = static_cast<double>((height + q * q) - (height_[count - 1] + p * p)) /
             static_cast<double>(2 * (q - p));
      if (count == 1 || from > from_[count - 1]) break;
    }
    foot_[count] = q;
    height_[count] = height;
    from_[count] = from;
    return count + 1;
  }

  std::vector<std::int64_t> foot_, height_;
  std::vector<double> from_;  ///< where a parabola becomes the lowest
};

}  // namespace

std::vector<std::int64_t> squared_distances(const OccupancyGrid& grid) {
  const auto width = static_cast<std::size_t>(grid.frame().width);
  const auto height = static_cast<std::size_t>(grid.frame().height);
  std::vector<std::int64_t> distances(width * height, kNoObstacle);
  for (std::size_t n = 0; n < distances.size(); ++n)
    if (grid.cells()[n] == kOccupiedCell) distances[n] = 0;
  LowerEnvelope columns(height), rows(width);
  for (std::size_t column = 0; column < width; ++column)
    columns.transform(distances.data() + column, height, width);
  for (std::size_t row = 0; row < height; ++row)
    rows.transform(distances.data() + row * width, width, 1);
  return distances;
}

}  // namespace mapscore
