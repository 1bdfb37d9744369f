// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <cstdint>

namespace mapscore {

/// Sum of the colours seen in a voxel, whose mean is exact in any order; 2^24 of them at most.
struct ColourSum {
  std::uint32_t r = 0, g = 0, b = 0, count = 0;

  bool operator==(const ColourSum&) const = default;

  void add(const Colour& colour) { *this += {colour.r, colour.g, colour.b, 1}; }
  ColourSum& operator+=(const ColourSum& other) {
    r += other.r, g += other.g, b += other.b, count += other.count;
    return *this;
  }
  /// Rounded to the nearest; black where there is none.
  [[nodiscard]] Colour mean() const {
    const auto channel = [&](std::uint32_t sum) {
      return static_cast<std::uint8_t>(count == 0 ? 0 : (sum + count / 2) / count);
    };
    return {channel(r), channel(g), channel(b)};
  }
};

}  // namespace mapscore
