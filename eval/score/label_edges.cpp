// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/label_edges.hpp"

#include "eval/score/metric.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mapscore::eval {
namespace {

/// Of pixels that are at no edge.
constexpr int kNoEdge = -1;

/// The class of each pixel at an edge, within a border of `margin` pixels without any.
cv::Mat1i edges_of(const cv::Mat1w& classes, int margin) {
  cv::Mat1i edges(classes.rows + 2 * margin, classes.cols + 2 * margin, kNoEdge);
  for (int v = 0; v < classes.rows; ++v) {
    const std::uint16_t* const row = classes[v];
    const std::uint16_t* const above = classes[std::max(v - 1, 0)];
    const std::uint16_t* const below = classes[std::min(v + 1, classes.rows - 1)];
    for (int u = 0; u < classes.cols; ++u) {
      const std::uint16_t id = row[u];
      if (above[u] != id || below[u] != id || row[std::max(u - 1, 0)] != id ||
          row[std::min(u + 1, classes.cols - 1)] != id)
        edges(v + margin, u + margin) = id;
    }
  }
  return edges;
}

/// Places within the tolerance, as offsets in an image with rows of `columns`, the nearest first.
std::vector<std::ptrdiff_t> offsets_within(int tolerance_px, int columns) {
  std::vector<std::pair<int, std::ptrdiff_t>> found;
  for (int v = -tolerance_px; v <= tolerance_px; ++v)
    for (int u = -tolerance_px; u <= tolerance_px; ++u)
      if (u * u + v * v <= tolerance_px * tolerance_px)
        found.emplace_back(u * u + v * v, static_cast<std::ptrdiff_t>(v) * columns + u);
  std::ranges::stable_sort(found, {}, &std::pair<int, std::ptrdiff_t>::first);
  std::vector<std::ptrdiff_t> offsets;
  for (const auto& [squared, offset] : found) offsets.push_back(offset);
  return offsets;
}

/// Calls act(class, whether an edge of it is near in `other`) for each pixel at an edge of `edges`.
void for_each_edge(const cv::Mat1i& edges, const cv::Mat1i& other,
                   const std::vector<std::ptrdiff_t>& offsets, const auto& act) {
  for (std::size_t at = 0; at < edges.total(); ++at) {
    const int id = edges[0][at];
    if (id == kNoEdge) continue;
    const int* const place = other[0] + at;
    act(static_cast<std::size_t>(id),
        std::ranges::any_of(offsets, [&](std::ptrdiff_t offset) { return place[offset] == id; }));
  }
}

}  // namespace

EdgeCounts& EdgeCounts::operator+=(const EdgeCounts& other) {
  true_px += other.true_px;
  found_px += other.found_px;
  named_px += other.named_px;
  right_px += other.right_px;
  return *this;
}

std::optional<double> boundary_f(const EdgeCounts& edges) {
  return f1(edges.right_px, edges.named_px, edges.found_px, edges.true_px);
}

int edge_tolerance_px(cv::Size size) {
  constexpr double kShareOfDiagonal = 0.0075;
  return std::max(
      1, static_cast<int>(std::lround(kShareOfDiagonal * std::hypot(size.width, size.height))));
}

std::vector<EdgeCounts> count_edges(const cv::Mat1w& truth, const cv::Mat1w& named,
                                    std::size_t class_count, int tolerance_px) {
  const cv::Mat1i true_edges = edges_of(truth, tolerance_px);
  const cv::Mat1i named_edges = edges_of(named, tolerance_px);
  const auto offsets = offsets_within(tolerance_px, true_edges.cols);
  std::vector<EdgeCounts> counts(class_count);
  for_each_edge(true_edges, named_edges, offsets, [&](std::size_t id, bool is_near) {
    ++counts.at(id).true_px;
    counts[id].found_px += is_near ? 1 : 0;
  });
  for_each_edge(named_edges, true_edges, offsets, [&](std::size_t id, bool is_near) {
    ++counts.at(id).named_px;
    counts[id].right_px += is_near ? 1 : 0;
  });
  return counts;
}

}  // namespace mapscore::eval
