// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include "core/segmentation/edge_aligned/near_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mapscore {
namespace {

constexpr float kLeastStep = 0.002F;  // 1/m: 8 mm at 2 m
constexpr float kStepSigmas = 4.0F;
constexpr int kWidestGap = 24;
constexpr double kShareOfRange = 0.9;  // surfaces farther than this may end because the range does

cv::Mat1f inverse_of(const cv::Mat1w& depth, const Calibration& believed) {
  cv::Mat1f inverse(depth.rows, depth.cols);
  const float least = static_cast<float>(believed.range_min_m * kDepthUnitsPerMetre - 1e-3);
  const float most = static_cast<float>(believed.range_max_m * kDepthUnitsPerMetre + 1e-3);
  for (int v = 0; v < depth.rows; ++v) {
    const std::uint16_t* in = depth[v];
    float* out = inverse[v];
    for (int u = 0; u < depth.cols; ++u) {
      const float value = static_cast<float>(in[u]);
      const float quotient = static_cast<float>(kDepthUnitsPerMetre) / std::max(value, 1.0F);
      out[u] = value >= least && value <= most ? quotient : 0.0F;
    }
  }
  return inverse;
}

/// Noise of the inverse depth, from the second differences of every eighth row: their 80th
/// percentile is 1.28 sigma sqrt(6), and edges are fewer than the rest.
float noise_of(const cv::Mat1f& inverse) {
  std::vector<float> differences;
  differences.reserve(static_cast<std::size_t>(inverse.total() / 16));
  for (int v = 4; v < inverse.rows; v += 8) {
    const float* w = inverse[v];
    for (int u = 1; u + 1 < inverse.cols; u += 2)
      if (w[u - 1] > 0 && w[u] > 0 && w[u + 1] > 0)
        differences.push_back(std::abs(w[u - 1] - 2 * w[u] + w[u + 1]));
  }
  if (differences.empty()) return 0.0F;
  const auto at = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 4 / 5);
  std::nth_element(differences.begin(), at, differences.end());
  return *at / (1.28F * 2.449F);
}

/// Four inverse depths in a line; `before` and `after` may be 0. How far p and q lie off each
/// other's line, `gap` pixels apart.
float step_between(float before, float p, float q, float after, int gap) {
  const float rise = q - p;
  const float slope_p = before > 0 ? p - before : 0.0F;
  const float slope_q = after > 0 ? after - q : 0.0F;
  const float across = static_cast<float>(gap);
  return std::min(std::abs(rise - across * slope_p), std::abs(rise - across * slope_q));
}

class EdgeFinder {
 public:
  EdgeFinder(const cv::Mat1w& depth, const Calibration& believed) : camera_(believed.depth) {
    edges_.inverse_depth = inverse_of(depth, believed);
    edges_.noise = noise_of(edges_.inverse_depth);
    edges_.near_holes = near_holes(edges_.inverse_depth, believed.range_min_m);
    farthest_ = static_cast<float>(1.0 / (kShareOfRange * believed.range_max_m));
    tau_ = std::max(kLeastStep, kStepSigmas * edges_.noise);
    edges_.right = cv::Mat1f(depth.rows, depth.cols, 0.0F);
    edges_.down = cv::Mat1f(depth.rows, depth.cols, 0.0F);
    last_row_.assign(static_cast<std::size_t>(depth.cols), -1);
  }

  DepthEdges find() {
    const cv::Mat1f& w = edges_.inverse_depth;
    for (int v = 0; v < w.rows; ++v) {
      const float* row = w[v];
      const float* above_row = v > 0 ? w[v - 1] : row;
      float *right = edges_.right[v], *down = edges_.down[std::max(v - 1, 0)];
      int last = -1;
      for (int u = 0; u < w.cols; ++u) {
        if (!(row[u] > 0)) continue;
        if (u - last > kWidestGap) beside_hole_in_row(v, last, u);
        if (last >= 0 && last == u - 1 && std::abs(row[u] - row[last]) <= tau_)
          right[last] = 1.0F;
        else if (last >= 0)
          across_row(v, last, u);
        last = u;
        int& above = last_row_[static_cast<std::size_t>(u)];
        if (v - above > kWidestGap) beside_hole_in_column(u, above, v);
        if (above >= 0 && above == v - 1 && std::abs(row[u] - above_row[u]) <= tau_)
          down[u] = 1.0F;
        else if (above >= 0)
          across_column(u, above, v);
        above = v;
      }
      if (w.cols - last > kWidestGap) beside_hole_in_row(v, last, w.cols);
    }
    for (int u = 0; u < w.cols; ++u) {
      const int last = last_row_[static_cast<std::size_t>(u)];
      if (w.rows - last > kWidestGap) beside_hole_in_column(u, last, w.rows);
    }
    return std::move(edges_);
  }

 private:
  void across_row(int v, int p, int q) {
    const float* w = edges_.inverse_depth[v];
    if (q == p + 1) edges_.right(v, p) = 1.0F;
    if (std::abs(w[q] - w[p]) <= tau_ || q - p > kWidestGap) return;
    const float strength =
        strength_of(step_between(p > 0 ? w[p - 1] : 0.0F, w[p], w[q],
                                 q + 1 < edges_.inverse_depth.cols ? w[q + 1] : 0.0F, q - p));
    if (strength <= 0) return;
    if (q == p + 1) edges_.right(v, p) = 1.0F - strength;
    if (w[p] > w[q])
      add(p + 0.5, v, w[p], Outward::right, strength);
    else
      add(q - 0.5, v, w[q], Outward::left, strength);
  }

  void across_column(int u, int p, int q) {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (q == p + 1) edges_.down(p, u) = 1.0F;
    if (std::abs(w(q, u) - w(p, u)) <= tau_ || q - p > kWidestGap) return;
    const float strength = strength_of(step_between(p > 0 ? w(p - 1, u) : 0.0F, w(p, u), w(q, u),
                                                    q + 1 < w.rows ? w(q + 1, u) : 0.0F, q - p));
    if (strength <= 0) return;
    if (q == p + 1) edges_.down(p, u) = 1.0F - strength;
    if (w(p, u) > w(q, u))
      add(u, p + 0.5, w(p, u), Outward::down, strength);
    else
      add(u, q - 0.5, w(q, u), Outward::up, strength);
  }

  /// A hole of a row that begins after column p and ends before q, either perhaps the border.
  void beside_hole_in_row(int v, int p, int q) {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (edges_.near_holes(v, (p + q) / 2) != 0) return;
    if (p >= 0 && w(v, p) > farthest_) add(p + 0.5, v, w(v, p), Outward::right, 1.0F);
    if (q < w.cols && w(v, q) > farthest_) add(q - 0.5, v, w(v, q), Outward::left, 1.0F);
  }

  void beside_hole_in_column(int u, int p, int q) {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (edges_.near_holes((p + q) / 2, u) != 0) return;
    if (p >= 0 && w(p, u) > farthest_) add(u, p + 0.5, w(p, u), Outward::down, 1.0F);
    if (q < w.rows && w(q, u) > farthest_) add(u, q - 0.5, w(q, u), Outward::up, 1.0F);
  }

  [[nodiscard]] float strength_of(float step) const {
    return std::clamp((step - tau_) / (2 * tau_), 0.0F, 1.0F);
  }

  void add(double u, double v, float inverse, Outward outward, float strength) {
    const Eigen::Vector3d point = camera_.back_project(u, v, 1.0 / static_cast<double>(inverse));
    edges_.steps.push_back({point.cast<float>(), outward, strength});
  }

  CameraModel camera_;
  float tau_ = 0, farthest_ = 0;
  std::vector<int> last_row_;  ///< by column: the last row with a depth
  DepthEdges edges_;
};

}  // namespace

DepthEdges find_depth_edges(const cv::Mat1w& depth, const Calibration& believed) {
  return EdgeFinder(depth, believed).find();
}

}  // namespace mapscore
