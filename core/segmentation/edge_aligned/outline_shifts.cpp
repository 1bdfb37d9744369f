// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/outline_shifts.hpp"

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/matched_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr int kPitch = OutlineShifts::kPitch_px;
constexpr float kTold = 0.25F;  // an alignment that explains less knows too little to tell
/// The same where the calibration is known: with less, what runs beside outlines without steps, as
/// the edge of a cabinet beside its doors, would be taken for theirs.
constexpr float kToldOfKnown = 0.5F;
constexpr float kSupport_px = 1.5F * kPitch;
constexpr float kFine_px = 1.5F, kWide_px = 3.0F;  // sigmas of the matches
constexpr float kGood = 0.6F;                      // share of an outline that shows a good fit
constexpr float kGain = 1.5F;                      // over what no shift explains, at the wide sigma
constexpr float kLeastLength = 12.0F;              // weighted outline elements about a node
constexpr int kShiftSearch = 15, kShiftStep = 3;   // px, of the shifts that are tried
constexpr float kSearch_px = kShiftSearch;
constexpr float kCostAtSearch = 0.15F;  // of the outline, for the largest shift

struct ShiftedEdge {
  Eigen::Vector2f at, outward;
  float strength;
  std::size_t tried =
      0;  ///< where its weights at all tried shifts begin; 0 while they are not known
};

std::vector<Eigen::Vector2f> tried_shifts() {
  std::vector<Eigen::Vector2f> shifts;
  for (int dv = -kShiftSearch; dv <= kShiftSearch; dv += kShiftStep)
    for (int du = -kShiftSearch; du <= kShiftSearch; du += kShiftStep)
      if (du * du + dv * dv <= kShiftSearch * kShiftSearch)
        shifts.emplace_back(static_cast<float>(du), static_cast<float>(dv));
  return shifts;
}

class ShiftFinder {
 public:
  ShiftFinder(const DepthEdges& edges, const OutlineField& field, const OutlineAlignment& alignment,
              const Calibration& believed)
      : field_(field),
        offset_px_(alignment.offset_px),
        rows_(field.distance.rows / kPitch + 2),
        columns_(field.distance.cols / kPitch + 2),
        cells_(static_cast<std::size_t>(rows_ * columns_)) {
    const Calibration mended = alignment.corrected(believed);
    const Projection project(mended.color);
    const Eigen::Isometry3f T = mended.T_color_depth.cast<float>();
    const Eigen::Matrix3f R = T.linear();
    const Eigen::Vector3f t = T.translation();
    for (const DepthEdge& edge : edges.steps) {
      const Eigen::Vector3f p = R * edge.point + t;
      if (!(p.z() > 0.05F)) continue;
      const Eigen::Vector2f at = project(p);
      if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<float>(field.distance.cols) &&
            at.y() < static_cast<float>(field.distance.rows)))
        continue;
      const int u = static_cast<int>(at.x()), v = static_cast<int>(at.y());
      if (std::abs(field.distance(v, u)) > kSearch_px + 12.0F) continue;
      cell(v / kPitch, u / kPitch).push_back({at, direction_of(edge.outward), edge.strength});
    }
  }

  OutlineShifts find() {
    const cv::Mat1f lengths = outline_lengths();
    OutlineShifts shifts;
    shifts.nodes = cv::Mat2f(rows_, columns_, cv::Vec2f(0, 0));
    bool any = false;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        if (lengths(row, column) < kLeastLength) continue;
        gather(row, column);
        if (near_.empty()) continue;
        const Eigen::Vector2f shift = shift_of(lengths(row, column));
        shifts.nodes(row, column) = {shift.x(), shift.y()};
        any = any || shift.squaredNorm() > 0;
      }
    if (!any) shifts.nodes.release();
    return shifts;
  }

 private:
  struct NearEdge {
    ShiftedEdge* edge;
    float support;
  };

  std::vector<ShiftedEdge>& cell(int row, int column) {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  }

  static float support(float du, float dv) {
    return std::max(0.0F, 1 - std::abs(du) / kSupport_px) *
           std::max(0.0F, 1 - std::abs(dv) / kSupport_px);
  }

  /// Outline elements about each node, weighted by their nearness.
  [[nodiscard]] cv::Mat1f outline_lengths() const {
    constexpr int kCell = 4;
    cv::Mat1f lengths(rows_, columns_, 0.0F);
    for (const cv::Mat1f& elements : field_.elements)
      for (int r = 0; r < elements.rows; ++r)
        for (int c = 0; c < elements.cols; ++c) {
          if (elements(r, c) <= 0) continue;
          const float u = static_cast<float>(kCell * c) + 1.5F,
                      v = static_cast<float>(kCell * r) + 1.5F;
          const int row = static_cast<int>(v) / kPitch, column = static_cast<int>(u) / kPitch;
          for (int i = std::max(0, row - 1); i <= std::min(rows_ - 1, row + 2); ++i)
            for (int j = std::max(0, column - 1); j <= std::min(columns_ - 1, column + 2); ++j)
              lengths(i, j) += elements(r, c) * support(u - static_cast<float>(j * kPitch),
                                                        v - static_cast<float>(i * kPitch));
        }
    return lengths;
  }

  void gather(int row, int column) {
    near_.clear();
    near_edges_.clear();
    for (int i = std::max(0, row - 2); i <= std::min(rows_ - 1, row + 1); ++i)
      for (int j = std::max(0, column - 2); j <= std::min(columns_ - 1, column + 1); ++j)
        for (ShiftedEdge& edge : cell(i, j)) {
          const float weight = support(edge.at.x() - static_cast<float>(column * kPitch),
                                       edge.at.y() - static_cast<float>(row * kPitch));
          if (weight <= 0) continue;
          near_.push_back({&edge, weight});
          near_edges_.push_back(edge.at, edge.outward, edge.strength);
        }
  }

  [[nodiscard]] float score(const Eigen::Vector2f& shift, float sigma) {
    float sum = 0;
    matched_.match_shifted(near_edges_, shift, offset_px_, sigma);
    matched_.for_each([&](std::size_t n) { sum += near_[n].support * matched_.weight[n]; });
    return sum;
  }

  /// Scores of all tried shifts. An edge lies near up to nine nodes, so what it weighs is kept.
  [[nodiscard]] std::vector<float> scores_of_tried() {
    try_new();
    std::vector<float> sums(tried_.size(), 0.0F);
    for (const NearEdge& near : near_) {
      const float* const weights = weights_.data() + near.edge->tried;
      for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += near.support * weights[n];
    }
    return sums;
  }

  /// Finds what those edges weigh at all tried shifts of which it is not known.
  void try_new() {
    std::vector<std::size_t> places;
    new_edges_.clear();
    for (const NearEdge& near : near_) {
      if (near.edge->tried != 0) continue;
      near.edge->tried = weights_.size();
      places.push_back(weights_.size());
      weights_.resize(weights_.size() + tried_.size());
      new_edges_.push_back(near.edge->at, near.edge->outward, near.edge->strength);
    }
    for (std::size_t k = 0; k < tried_.size(); ++k) {
      matched_.match_shifted(new_edges_, tried_[k], offset_px_, kWide_px);
      matched_.for_each([&](std::size_t n) { weights_[places[n] + k] = matched_.weight[n]; });
    }
  }

  [[nodiscard]] Eigen::Vector2f shift_of(float length) {
    const Eigen::Vector2f none(0, 0);
    const float unshifted = score(none, kFine_px);
    const auto gained = [&](const Eigen::Vector2f& shift, float least) {
      return score(shift, kFine_px) > least * unshifted;
    };
    const Eigen::Vector2f near = refined(none, length);
    const Eigen::Vector2f fallback = gained(near, 1.08F) ? near : none;
    if (unshifted > kGood * length) return fallback;
    Eigen::Vector2f best = none;
    const std::vector<float> scores = scores_of_tried();
    const float unshifted_wide = scores[none_tried_];
    float most = unshifted_wide;
    for (std::size_t n = 0; n < tried_.size(); ++n) {
      const float value =
          scores[n] - kCostAtSearch * length * tried_[n].squaredNorm() / (kSearch_px * kSearch_px);
      if (value > most) most = value, best = tried_[n];
    }
    best = refined(best, length);
    const float shifted = score(best, kFine_px);
    const bool accepted = shifted > kGain * unshifted_wide && shifted > 0.5F * kGood * length;
    return accepted ? best : fallback;
  }

  /// Gauss-Newton about a shift, pulled weakly to none.
  [[nodiscard]] Eigen::Vector2f refined(Eigen::Vector2f shift, float length) {
    const Eigen::Vector2f start = shift;
    for (int step = 0; step < 5; ++step) {
      Eigen::Matrix2f H = Eigen::Matrix2f::Identity() * (0.02F * length);
      Eigen::Vector2f b = -0.02F * length * (shift - start);
      matched_.match_shifted(near_edges_, shift, offset_px_, kFine_px);
      matched_.for_each([&](std::size_t n) {
        const Eigen::Vector2f slope(matched_.slope_u[n], matched_.slope_v[n]);
        const float weight = near_[n].support * matched_.weight[n];
        H += weight * slope * slope.transpose();
        b -= weight * matched_.residual[n] * slope;
      });
      shift += H.inverse() * b;
    }
    return shift;
  }

  const OutlineField& field_;
  float offset_px_;
  int rows_, columns_;
  std::vector<std::vector<ShiftedEdge>> cells_;
  std::vector<NearEdge> near_;
  PlacedEdges near_edges_;  ///< those of near_, in its order
  PlacedEdges new_edges_;   ///< those of them that no shift was tried of
  MatchedEdges matched_{field_};
  std::vector<Eigen::Vector2f> tried_ = tried_shifts();
  std::size_t none_tried_ =
      static_cast<std::size_t>(std::ranges::find(tried_, Eigen::Vector2f(0, 0)) - tried_.begin());
  std::vector<float> weights_{0.0F};  ///< of edges at all tried shifts; the first is nobody's
};

}  // namespace

cv::Vec2f OutlineShifts::at(float u, float v) const {
  const float x = u / kPitch_px, y = v / kPitch_px;
  const int column = std::clamp(static_cast<int>(x), 0, nodes.cols - 2);
  const int row = std::clamp(static_cast<int>(y), 0, nodes.rows - 2);
  const float a = std::clamp(x - static_cast<float>(column), 0.0F, 1.0F);
  const float b = std::clamp(y - static_cast<float>(row), 0.0F, 1.0F);
  return (1 - b) * ((1 - a) * nodes(row, column) + a * nodes(row, column + 1)) +
         b * ((1 - a) * nodes(row + 1, column) + a * nodes(row + 1, column + 1));
}

OutlineShifts find_outline_shifts(const DepthEdges& edges, const OutlineField& field,
                                  const OutlineAlignment& alignment, const Calibration& believed,
                                  bool is_known) {
  if (alignment.is_sharp() || alignment.score < (is_known ? kToldOfKnown : kTold)) return {};
  return ShiftFinder(edges, field, alignment, believed).find();
}

}  // namespace mapscore
