// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace mapscore {

/// Row filters of PNG (its specification, section 9): a row is one byte that names the filter, then
/// the bytes of the row less a prediction from the byte to the left (a), above (b) and above left
/// (c).
struct RowLayout {
  int rows = 0;
  std::size_t row_bytes = 0;    ///< without the filter's byte
  std::size_t pixel_bytes = 0;  ///< distance to the byte on the left
};

/// Replaces the rows of `image` (rows * row_bytes bytes) by filter `up`, each with its filter's
/// byte before it: of all filters the one that both ways is a plain loop over a row.
[[nodiscard]] std::string filter_rows(const std::string& image, const RowLayout& layout);

/// Undoes any filter in place; `filtered` has rows * (1 + row_bytes) bytes and keeps the filters'
/// bytes. Returns false when a row names a filter that does not exist.
[[nodiscard]] bool unfilter_rows(std::uint8_t* filtered, const RowLayout& layout);

}  // namespace mapscore
