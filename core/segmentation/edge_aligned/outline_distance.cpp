// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_distance.hpp"

#include "core/wide_vectors.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr std::int32_t kUnits = 1 << 16;  // a pixel
constexpr std::int32_t kStraight = 62587, kDiagonal = 89738;
constexpr std::int32_t kUnknown = 1 << 29;  // 8192 pixels

/// By value: std::min chooses between places, which do not become vectors.
inline std::int32_t least(std::int32_t a, std::int32_t b) {
  return a < b ? a : b;
}

/// Sets to 0 the ways of the pixels on a rim; `ways` begin at column 0.
MAPSCORE_WIDE_VECTORS
void start_at_rim(const cv::Mat1w& owner, int v, std::int32_t* ways) {
  const int last = owner.cols - 1;
  const std::uint16_t* row = owner[v];
  const std::uint16_t* above = v > 0 ? owner[v - 1] : row;
  const std::uint16_t* below = v + 1 < owner.rows ? owner[v + 1] : row;
  const auto start = [&](int u, std::uint16_t left, std::uint16_t right) {
    const std::uint16_t own = row[u];
    const unsigned differ = static_cast<unsigned>(left ^ own) | static_cast<unsigned>(right ^ own) |
                            static_cast<unsigned>(above[u] ^ own) |
                            static_cast<unsigned>(below[u] ^ own);
    ways[u] = own != 0 && differ != 0 ? 0 : ways[u];
  };
  for (int u = 1; u < last; ++u) start(u, row[u - 1], row[u + 1]);
  start(0, row[0], row[std::min(1, last)]);
  start(last, row[std::max(last - 1, 0)], row[last]);
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
    const float way = static_cast<float>(ways[u]) * (1.0F / kUnits);
    const float inside = -0.5F - way, outside = way - 0.5F;
    distances[u] = owner[u] != 0 ? inside : outside;
  }
}

/// Shortens ways that come along the row from `first` on, `step` pixels at a time. Four at once
/// wait for the one before them, not for each other.
template <int kStep>
void step_along(std::int32_t* first, int columns) {
  std::int32_t before = kUnknown;
  const auto at = [first](int n) -> std::int32_t& { return first[kStep * n]; };
  int n = 0;
  for (; n + 4 <= columns; n += 4) {
    const std::int32_t a = at(n), b = least(at(n + 1), a + kStraight),
                       c = least(at(n + 2), b + kStraight), d = least(at(n + 3), c + kStraight);
    at(n) = least(a, before + kStraight);
    at(n + 1) = least(b, before + 2 * kStraight);
    at(n + 2) = least(c, before + 3 * kStraight);
    before = at(n + 3) = least(d, before + 4 * kStraight);
  }
  for (; n < columns; ++n) before = at(n) = least(at(n), before + kStraight);
}

}  // namespace

/// One field serves both sides: no shortest way crosses a rim, since of two pixels on either side
/// of it one is on it, or they touch at a corner, and their common neighbours are nearer. Between
/// the passes `distance` keeps the bits of the ways found so far.
void measure_outline_distance(const cv::Mat1w& owner, cv::Mat1f distance) {
  const int columns = owner.cols;
  std::vector<std::int32_t> rows[2];  // the last and this one, a pixel wider on both sides
  for (auto& row : rows) row.assign(static_cast<std::size_t>(columns) + 2, kUnknown);
  for (int v = 0; v < owner.rows; ++v) {
    std::int32_t* ways = rows[v % 2].data() + 1;
    std::fill_n(ways, columns, kUnknown);
    step_across(rows[1 - v % 2].data() + 1, ways, columns);
    start_at_rim(owner, v, ways);
    step_along<1>(ways, columns);
    std::transform(ways, ways + columns, distance[v], std::bit_cast<float, std::int32_t>);
  }
  for (auto& row : rows) std::fill(row.begin(), row.end(), kUnknown);
  for (int v = owner.rows - 1; v >= 0; --v) {
    std::int32_t* ways = rows[v % 2].data() + 1;
    std::transform(distance[v], distance[v] + columns, ways, std::bit_cast<std::int32_t, float>);
    step_across(rows[1 - v % 2].data() + 1, ways, columns);
    step_along<-1>(ways + columns - 1, columns);
    write_distances(owner[v], ways, distance[v], columns);
  }
}

}  // namespace mapscore
