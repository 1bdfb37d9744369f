// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_distance.hpp"

#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace mapscore {
namespace {

constexpr std::int32_t kUnits = 1 << 16;  // a pixel
/// Steps are multiples of 4, so the lowest two bits of a way tell at which Border it began.
constexpr std::int32_t kStraight = 62588, kDiagonal = 89740;
constexpr std::int32_t kUnknown = 1 << 29;  // 8192 pixels

/// By value: std::min chooses between places, which do not become vectors.
inline std::int32_t least(std::int32_t a, std::int32_t b) {
  return a < b ? a : b;
}

/// A row of pixels and its neighbours; beyond the image it repeats itself.
struct OwnerRows {
  const std::uint16_t *above, *row, *below;
  int columns;

  OwnerRows(const cv::Mat1w& owner, int v)
      : above(owner[std::max(v - 1, 0)]),
        row(owner[v]),
        below(owner[std::min(v + 1, owner.rows - 1)]),
        columns(owner.cols) {}

  [[nodiscard]] std::array<std::uint16_t, 4> beside(int u) const {
    return {row[std::max(u - 1, 0)], row[std::min(u + 1, columns - 1)], above[u], below[u]};
  }
};

/// Marks the pixels of a row that are on a rim.
MAPSCORE_WIDE_VECTORS
void mark_rim(const OwnerRows& rows, std::uint8_t* __restrict marks) {
  const std::uint16_t *row = rows.row, *above = rows.above, *below = rows.below;
  const int last = rows.columns - 1;
  const auto mark = [&](int u, std::uint16_t left, std::uint16_t right) {
    const std::uint16_t own = row[u];
    const unsigned differ = static_cast<unsigned>(left ^ own) | static_cast<unsigned>(right ^ own) |
                            static_cast<unsigned>(above[u] ^ own) |
                            static_cast<unsigned>(below[u] ^ own);
    marks[u] = static_cast<std::uint8_t>((own != 0) & (differ != 0));
  };
  for (int u = 1; u < last; ++u) mark(u, row[u - 1], row[u + 1]);
  mark(0, row[0], row[std::min(1, last)]);
  mark(last, row[std::max(last - 1, 0)], row[last]);
}

/// What a way that begins on a rim pixel begins with: its Border.
std::int32_t way_from_rim(const OwnerRows& rows, int u) {
  const std::uint16_t own = rows.row[u];
  std::int32_t way = kNoBorder;
  for (const std::uint16_t other : rows.beside(u)) {
    if (other > own) return kBesideHigher;
    if (other != 0 && other < own) way = kBesideLower;
  }
  return way;
}

/// Shortest ways along a row from two of its rim pixels to those from `begin` on; `left` and
/// `right`: the ways to the pixels before and behind them.
MAPSCORE_WIDE_VECTORS
void fill_between(std::int32_t left, std::int32_t right, int begin, int end,
                  std::int32_t* __restrict ways) {
  for (int u = begin; u < end; ++u)
    ways[u] = least(left + (u - begin + 1) * kStraight, right + (end - u) * kStraight);
}

/// Shortens ways that begin with a step to the neighbouring row.
MAPSCORE_WIDE_VECTORS
void step_across(const std::int32_t* neighbour, std::int32_t* __restrict ways, int columns) {
  for (int u = 0; u < columns; ++u) {
    const std::int32_t diagonal = least(neighbour[u - 1], neighbour[u + 1]) + kDiagonal;
    ways[u] = least(ways[u], least(neighbour[u] + kStraight, diagonal));
  }
}

MAPSCORE_WIDE_VECTORS
void write_distances(const std::uint16_t* owner, const std::int32_t* ways, float* distances,
                     int columns) {
  for (int u = 0; u < columns; ++u) {
    const std::int32_t border = owner[u] != 0 ? ways[u] & kBorderBits : kNoBorder;
    const float way = static_cast<float>(ways[u] & ~kBorderBits) * (1.0F / kUnits);
    const float inside = -0.5F - way, outside = way - 0.5F;
    const float distance = owner[u] != 0 ? inside : outside;
    distances[u] =
        std::bit_cast<float>((std::bit_cast<std::int32_t>(distance) & ~kBorderBits) | border);
  }
}

/// Shortest ways along a row from its rim pixels.
void step_along(const OwnerRows& rows, const Marks& rim, std::int32_t* ways) {
  int begin = 0;
  std::int32_t left = kUnknown;
  const auto fill_until = [&](int end, std::int32_t right) {
    if (left == kUnknown) left = right + (end - begin + 1) * kStraight;
    fill_between(left, right, begin, end, ways);
    if (end < rows.columns) ways[end] = right;
    begin = end + 1, left = right;
  };
  for_each_marked(rim, [&](int u) { fill_until(u, way_from_rim(rows, u)); });
  if (begin == 0)
    std::fill_n(ways, rows.columns, kUnknown);
  else
    fill_until(rows.columns, left + (rows.columns - begin + 1) * kStraight);
}

}  // namespace

/// One field serves both sides: no shortest way crosses a rim, since of two pixels on either side
/// of it one is on it, or they touch at a corner, and their common neighbours are nearer. The steps
/// of a shortest way may come in any order: those along the row first, then those from row to row,
/// all down or all up. Between the passes `distance` keeps the bits of the ways found so far.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance) {
  const int columns = owner.cols;
  const std::size_t row_bytes = static_cast<std::size_t>(columns) * sizeof(float);
  static_assert(sizeof(float) == sizeof(std::int32_t));
  std::vector<std::int32_t> rows[2];  // the last and this one, a pixel wider on both sides
  for (auto& row : rows) row.assign(static_cast<std::size_t>(columns) + 2, kUnknown);
  Marks rim(static_cast<std::size_t>(columns));
  for (int v = 0; v < owner.rows; ++v) {
    std::int32_t* ways = rows[v % 2].data() + 1;
    const OwnerRows about(owner, v);
    mark_rim(about, rim.data());
    step_along(about, rim, ways);
    step_across(rows[1 - v % 2].data() + 1, ways, columns);
    std::memcpy(distance[v], ways, row_bytes);
  }
  for (auto& row : rows) std::fill(row.begin(), row.end(), kUnknown);
  for (int v = owner.rows - 1; v >= 0; --v) {
    std::int32_t* ways = rows[v % 2].data() + 1;
    std::memcpy(ways, distance[v], row_bytes);
    step_across(rows[1 - v % 2].data() + 1, ways, columns);
    write_distances(owner[v], ways, distance[v], columns);
  }
}

}  // namespace mapscore
