// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png_rows.hpp"

#include <cstdlib>
#include <cstring>
#include <vector>

namespace mapscore {
namespace {

enum Filter : std::uint8_t { none = 0, sub = 1, up = 2, average = 3, paeth = 4 };

std::uint8_t wrap(int value) {
  return static_cast<std::uint8_t>(value);
}

/// Whichever of a, b, c is nearest to a + b - c, in this order.
int paeth_of(int a, int b, int c) {
  const int from_a = std::abs(b - c), from_b = std::abs(a - c), from_c = std::abs(a + b - 2 * c);
  if (from_a <= from_b && from_a <= from_c) return a;
  return from_b <= from_c ? b : c;
}

/// `row` holds differences and becomes bytes; `above` is the row before, all zero for the first.
bool unfilter(std::uint8_t filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes,
              std::size_t step) {
  switch (filter) {
    case none:
      return true;
    case sub:
      for (std::size_t i = step; i < bytes; ++i) row[i] = wrap(row[i] + row[i - step]);
      return true;
    case up:
      for (std::size_t i = 0; i < bytes; ++i) row[i] = wrap(row[i] + above[i]);
      return true;
    case average:
      for (std::size_t i = 0; i < bytes; ++i)
        row[i] = wrap(row[i] + ((i < step ? 0 : row[i - step]) + above[i]) / 2);
      return true;
    case paeth:
      for (std::size_t i = 0; i < bytes; ++i)
        row[i] = wrap(row[i] +
                      (i < step ? above[i] : paeth_of(row[i - step], above[i], above[i - step])));
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string filter_rows(const std::string& image, const RowLayout& layout) {
  std::string filtered(static_cast<std::size_t>(layout.rows) * (1 + layout.row_bytes), '\0');
  const std::vector<char> zeros(layout.row_bytes, 0);
  const char* above = zeros.data();
  const char* row = image.data();
  char* out = filtered.data();
  for (int v = 0; v < layout.rows; ++v) {
    *out++ = static_cast<char>(up);
    for (std::size_t i = 0; i < layout.row_bytes; ++i)
      out[i] = static_cast<char>(wrap(row[i] - above[i]));
    above = row;
    row += layout.row_bytes;
    out += layout.row_bytes;
  }
  return filtered;
}

bool unfilter_rows(std::uint8_t* filtered, const RowLayout& layout) {
  const std::vector<std::uint8_t> zeros(layout.row_bytes, 0);
  const std::uint8_t* above = zeros.data();
  for (int v = 0; v < layout.rows; ++v) {
    std::uint8_t* row = filtered + 1;
    if (!unfilter(filtered[0], row, above, layout.row_bytes, layout.pixel_bytes)) return false;
    above = row;
    filtered = row + layout.row_bytes;
  }
  return true;
}

}  // namespace mapscore
