// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>

namespace mapscore {

/// Values of the windows about kWindows pixels, for their medians. A window need not have a
/// value at each of its places.
struct WindowValues {
  static constexpr std::size_t kWindows = 16;
  static constexpr std::size_t kPlaces = 72;
  static constexpr float kNone = 1e30F;  ///< larger than any value

  using Row = std::array<float, kWindows>;
  std::array<Row, kPlaces> at;  ///< by place, of each window; kNone where it has none
};

/// The middle value of each window, the larger of two; 0 of a window without values. All windows
/// are searched at once, between two values that draw nearer, so that none is sorted.
[[nodiscard]] WindowValues::Row medians_of(const WindowValues& values);

}  // namespace mapscore
