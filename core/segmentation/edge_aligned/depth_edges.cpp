// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include "core/segmentation/edge_aligned/near_holes.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mapscore {
namespace {

constexpr float kLeastStep = 0.002F;  // 1/m: 8 mm at 2 m
constexpr float kStepSigmas = 4.0F;
constexpr float kNoisy = 0.0005F;  // 1/m: kStepSigmas reach the least step
constexpr int kWidestGap = 24;
constexpr int kInner_px = 6;                // behind the outermost step of a surface
constexpr float kWidestBaseline_m = 0.08F;  // between a depth camera and its projector
constexpr float kShadowRim_px = 4.0F;       // that lateral noise adds to a shadow
constexpr double kShareOfRange = 0.9;  // surfaces farther than this may end because the range does

/// Inverse depths, 1/m, of a row; 0 where the depth is not from `least` to `most`.
MAPSCORE_WIDE_VECTORS
void invert_row(const std::uint16_t* depth, float least, float most, int columns, float* inverse) {
  for (int u = 0; u < columns; ++u) {
    const float value = static_cast<float>(depth[u]);
    const float quotient = static_cast<float>(kDepthUnitsPerMetre) / (value < 1.0F ? 1.0F : value);
    const bool is_valid = (value >= least) & (value <= most);
    inverse[u] = is_valid ? quotient : 0.0F;
  }
}

cv::Mat1f inverse_of(const cv::Mat1w& depth, const Calibration& believed) {
  cv::Mat1f inverse(depth.rows, depth.cols);
  const float least =  // 0 is no depth
      static_cast<float>(std::max(1.0, believed.range_min_m * kDepthUnitsPerMetre) - 1e-3);
  const float most = static_cast<float>(believed.range_max_m * kDepthUnitsPerMetre + 1e-3);
  for (int v = 0; v < depth.rows; ++v) invert_row(depth[v], least, most, depth.cols, inverse[v]);
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

/// Some rows about a row of inverse depths, 1/m; 0 where there is no depth.
struct RowsAbout {
  const float *above2, *above, *row, *below;
};

/// Where a surface goes on from a pixel to the next of a row, `right`, and to it from the row
/// above, `down`: both have a depth, and are no step. 1 there, 0 elsewhere. `flags`: 1 at pixels
/// with a depth that one of the two does not lead to. No step: step_between by up to tau, which is
/// written out here, since a call of it does not become vectors.
MAPSCORE_WIDE_VECTORS
void go_on(const RowsAbout& rows, float tau, int columns, float* __restrict right,
           float* __restrict down, std::uint8_t* __restrict flags) {
  const float *row = rows.row, *above = rows.above, *above2 = rows.above2, *below = rows.below;
  const auto on = [tau](float before, float p, float q, float after) {
    const float rise = q - p;
    const float off_p = std::abs(rise - (before > 0 ? p - before : 0.0F));
    const float off_q = std::abs(rise - (after > 0 ? after - q : 0.0F));
    return static_cast<int>(p > 0) & static_cast<int>(q > 0) &
           (static_cast<int>(std::abs(rise) <= tau) | static_cast<int>(off_p <= tau) |
            static_cast<int>(off_q <= tau));
  };
  const auto set_right = [&](int u, float before, float after) {
    right[u] = on(before, row[u], row[u + 1], after) != 0 ? 1.0F : 0.0F;
  };
  for (int u = 1; u + 2 < columns; ++u) set_right(u, row[u - 1], row[u + 2]);
  if (columns > 1) set_right(0, 0, columns > 2 ? row[2] : 0.0F);
  if (columns > 2) set_right(columns - 2, row[columns - 3], 0);
  right[columns - 1] = 0;
  for (int u = 0; u < columns; ++u)
    down[u] = on(above2[u], above[u], row[u], below[u]) != 0 ? 1.0F : 0.0F;
  flags[0] = static_cast<std::uint8_t>(row[0] > 0);
  for (int u = 1; u < columns; ++u)
    flags[u] = static_cast<std::uint8_t>(
        static_cast<int>(row[u] > 0) &
        (1 ^ (static_cast<int>(right[u - 1] > 0) & static_cast<int>(down[u] > 0))));
}

/// Keeps by column the last row with a depth.
MAPSCORE_WIDE_VECTORS
void keep_last(const float* w, int row, int columns, int* __restrict last) {
  for (int u = 0; u < columns; ++u) last[u] = w[u] > 0 ? row : last[u];
}

class EdgeFinder {
 public:
  EdgeFinder(const cv::Mat1w& depth, const Calibration& believed, const DepthEdgeRules& rules)
      : rules_(rules), camera_(believed.depth) {
    edges_.inverse_depth = inverse_of(depth, believed);
    edges_.noise = noise_of(edges_.inverse_depth);
    edges_.near_holes = near_holes(edges_.inverse_depth, believed.range_min_m);
    farthest_ = static_cast<float>(1.0 / (kShareOfRange * believed.range_max_m));
    tau_ = std::max(kLeastStep, kStepSigmas * edges_.noise);
    last_[0] = last_[1] = std::vector<LastStep>(static_cast<std::size_t>(depth.rows));
    last_[2] = last_[3] = std::vector<LastStep>(static_cast<std::size_t>(depth.cols));
    last_rows_.assign(static_cast<std::size_t>(depth.cols), -1);
    edges_.right.create(depth.size());
    edges_.down.create(depth.size());
  }

  DepthEdges find() {
    const cv::Mat1f& w = edges_.inverse_depth;
    std::vector<float> unused(static_cast<std::size_t>(w.cols));
    const std::vector<float> nothing(unused.size(), 0.0F);
    Marks flags(unused.size());
    for (int v = 0; v < w.rows; ++v) {
      float* const down = v > 0 ? edges_.down[v - 1] : unused.data();
      const auto row = [&](int n) { return n >= 0 && n < w.rows ? w[n] : nothing.data(); };
      go_on({row(v - 2), row(v - 1), w[v], row(v + 1)}, tau_, w.cols, edges_.right[v], down,
            flags.data());
      for_each_marked(flags, [&](int u) { look_back(v, u); });
      const int last = last_in_row(v, w.cols);
      if (w.cols - last > kWidestGap) beside_hole_in_row(v, last, w.cols);
      keep_last(w[v], v, w.cols, last_rows_.data());
    }
    if (!w.empty()) edges_.down.row(w.rows - 1).setTo(0);
    for (int u = 0; u < w.cols; ++u) {
      const int last = last_in_column(u);
      if (w.rows - last > kWidestGap) beside_hole_in_column(u, last, w.rows);
    }
    std::erase_if(edges_.steps, [](const DepthEdge& edge) { return edge.strength <= 0; });
    return std::move(edges_);
  }

 private:
  /// The last pixel with a depth before a place of a row, and before this row of a column; -1 where
  /// there is none.
  [[nodiscard]] int last_in_row(int v, int before) const {
    const float* row = edges_.inverse_depth[v];
    int last = before - 1;
    while (last >= 0 && !(row[last] > 0)) --last;
    return last;
  }
  [[nodiscard]] int last_in_column(int u) const { return last_rows_[static_cast<std::size_t>(u)]; }

  /// What lies between a pixel with a depth and the ones before it in its row and its column, where
  /// a surface does not plainly go on.
  void look_back(int v, int u) {
    const int left = last_in_row(v, u), above = last_in_column(u);
    if (u - left > kWidestGap) beside_hole_in_row(v, left, u);
    if (left >= 0 && (left != u - 1 || edges_.right(v, left) < 1.0F)) across_row(v, left, u);
    if (v - above > kWidestGap) beside_hole_in_column(u, above, v);
    if (above >= 0 && (above != v - 1 || edges_.down(above, u) < 1.0F)) across_column(u, above, v);
  }

  void across_row(int v, int p, int q) {
    const float* w = edges_.inverse_depth[v];
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

  [[nodiscard]] bool is_near_hole(int v, int u) const {
    return edges_.near_holes(v / kHoleCell_px, u / kHoleCell_px) == kNearHole;
  }

  /// A hole of a row that begins after column p and ends before q, either perhaps the border.
  void beside_hole_in_row(int v, int p, int q) {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (is_near_hole(v, (p + q) / 2)) {
      if (may_be_shadow(v, p, q)) add(q - 0.5, v, w(v, q), Outward::left, 1.0F);
      return;
    }
    if (p >= 0 && w(v, p) > farthest_) add(p + 0.5, v, w(v, p), Outward::right, 1.0F);
    if (q < w.cols && w(v, q) > farthest_) add(q - 0.5, v, w(v, q), Outward::left, 1.0F);
  }

  /// Whether the hole between two columns of a row is no wider than a shadow of what ends it.
  [[nodiscard]] bool may_be_shadow(int v, int p, int q) const {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (!rules_.shadow_ends || !is_noisy(edges_) || p < 0 || q >= w.cols) return false;
    const float nearer_by = w(v, q) - w(v, p);
    return nearer_by > tau_ &&
           static_cast<float>(q - p - 1) <=
               kWidestBaseline_m * static_cast<float>(camera_.fx_px) * nearer_by + kShadowRim_px;
  }

  void beside_hole_in_column(int u, int p, int q) {
    const cv::Mat1f& w = edges_.inverse_depth;
    if (is_near_hole((p + q) / 2, u)) return;
    if (p >= 0 && w(p, u) > farthest_) add(u, p + 0.5, w(p, u), Outward::down, 1.0F);
    if (q < w.rows && w(q, u) > farthest_) add(u, q - 0.5, w(q, u), Outward::up, 1.0F);
  }

  [[nodiscard]] float strength_of(float step) const {
    return std::clamp((step - tau_) / (2 * tau_), 0.0F, 1.0F);
  }

  /// A step; of two at one depth that face alike, the inner one gets strength 0.
  void add(double u, double v, float inverse, Outward outward, float strength) {
    const bool in_row = outward == Outward::right || outward == Outward::left;
    const int along = static_cast<int>(std::floor(in_row ? u : v));
    LastStep& last =
        last_.at(static_cast<std::size_t>(outward)).at(static_cast<std::size_t>(in_row ? v : u));
    if (along - last.along <= kInner_px &&
        std::abs(last.inverse - inverse) <= rules_.same_depth * std::max(last.inverse, inverse)) {
      const bool last_is_inner = outward == Outward::right || outward == Outward::down;
      (last_is_inner ? edges_.steps[last.number].strength : strength) = 0;
    }
    last = {along, inverse, edges_.steps.size()};
    const Eigen::Vector3d point = camera_.back_project(u, v, 1.0 / static_cast<double>(inverse));
    edges_.steps.push_back({point.cast<float>(), outward, strength});
  }

  /// The step that was found last in a row or a column.
  struct LastStep {
    int along = -2 * kInner_px;
    float inverse = 0;
    std::size_t number = 0;
  };

  DepthEdgeRules rules_;
  CameraModel camera_;
  std::vector<int> last_rows_;  ///< by column: of the last pixel with a depth above this row, or -1
  std::array<std::vector<LastStep>, 4> last_;  ///< by Outward and row or column
  float tau_ = 0, farthest_ = 0;
  DepthEdges edges_;
};

}  // namespace

bool is_noisy(const DepthEdges& edges) {
  return edges.noise > kNoisy;
}

DepthEdges find_depth_edges(const cv::Mat1w& depth, const Calibration& believed,
                            const DepthEdgeRules& rules) {
  return EdgeFinder(depth, believed, rules).find();
}

}  // namespace mapscore
