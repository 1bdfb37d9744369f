// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/ragged_field.hpp"

#include "core/random_stream.hpp"

#include <cmath>
#include <vector>

namespace mapscore::sim {
namespace {

/// Nodes 0 .. count - 1 of one row of the lattice.
std::vector<double> node_row(std::uint64_t seed, std::uint64_t frame, std::uint64_t instance,
                             int row, int count) {
  RandomStream stream(seed, "labels.ragged", {frame, instance, static_cast<std::uint64_t>(row)});
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(stream.normal());
  return nodes;
}

}  // namespace

cv::Mat1f ragged_field(const cv::Rect& window, double pitch_px, std::uint64_t seed,
                       std::uint64_t frame, std::uint64_t instance) {
  cv::Mat1f field(window.size());
  const int columns = static_cast<int>(window.br().x / pitch_px) + 2;
  std::vector<double> above, below;
  int above_row = -1;
  for (int v = 0; v < window.height; ++v) {
    const double y = (window.y + v) / pitch_px, fy = y - std::floor(y);
    const int row = static_cast<int>(y);
    if (row != above_row) {
      above = node_row(seed, frame, instance, row, columns);
      below = node_row(seed, frame, instance, row + 1, columns);
      above_row = row;
    }
    for (int u = 0; u < window.width; ++u) {
      const double x = (window.x + u) / pitch_px, fx = x - std::floor(x);
      const auto i = static_cast<std::size_t>(x);
      const double sum = (1 - fy) * ((1 - fx) * above[i] + fx * above[i + 1]) +
                         fy * ((1 - fx) * below[i] + fx * below[i + 1]);
      const double squares = ((1 - fy) * (1 - fy) + fy * fy) * ((1 - fx) * (1 - fx) + fx * fx);
      field(v, u) = static_cast<float>(sum / std::sqrt(squares));
    }
  }
  return field;
}

}  // namespace mapscore::sim
