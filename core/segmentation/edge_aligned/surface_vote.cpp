// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_vote.hpp"

#include "core/segmentation/edge_aligned/filled_slits.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr float kHidden = 0.015F;   // share of inverse depth by which a hidden pixel lies behind
constexpr float kSlopes = 2.0F;     // pixels that a surface may rise by itself
constexpr float kNoise = 4.0F;      // sigmas that it may be off
constexpr float kSureAt_px = 2.0F;  // from the outline a pixel's vote has full weight
constexpr float kLeastVote = 0.05F;
constexpr float kHiddenVote = 0.2F;  // against every object
constexpr float kGrown_px = 0.5F;    // from here on masks may have filled slits
constexpr int kRounds = 3;
constexpr float kShare = 0.8F;  // of the votes; only where a surface goes on does it trim
/// Of a vote for another object: the share is reached by half of two objects' votes.
constexpr float kOtherVote = (1 - kShare) / kShare;

/// What the masks say of each depth pixel.
struct Votes {
  cv::Mat1w owner;     ///< 1 + detection whose mask is nearest
  cv::Mat1f depth_in;  ///< pixels inside its object, negative outside
  cv::Mat1f weight;    ///< little where the colour camera does not see the surface
};

class Voting {
 public:
  Voting(const DepthEdges& edges, const OutlineField& field, const OutlineAlignment& alignment,
         const Calibration& believed)
      : edges_(edges), field_(field), alignment_(alignment), believed_(believed) {}

  void project() {
    const cv::Mat1f& w = edges_.inverse_depth;
    u_.create(w.rows, w.cols);
    v_.create(w.rows, w.cols);
    const Eigen::Matrix3f R = alignment_.rotation * believed_.T_color_depth.linear().cast<float>();
    const Eigen::Vector3f t =
        alignment_.rotation * believed_.T_color_depth.translation().cast<float>() +
        alignment_.translation;
    const auto& color = believed_.color;
    const auto& depth = believed_.depth;
    const float fx = static_cast<float>(color.fx_px), fy = static_cast<float>(color.fy_px);
    const float cx = static_cast<float>(color.cx_px), cy = static_cast<float>(color.cy_px);
    // With p = z (ray), p_color / z = R ray + t w.
    for (int v = 0; v < w.rows; ++v) {
      const float y = (static_cast<float>(v) - static_cast<float>(depth.cy_px)) /
                      static_cast<float>(depth.fy_px);
      const float inverse_f = 1.0F / static_cast<float>(depth.fx_px);
      const float centre = static_cast<float>(depth.cx_px);
      const float* in = w[v];
      float *u_out = u_[v], *v_out = v_[v];
      for (int u = 0; u < w.cols; ++u) {
        const float x = (static_cast<float>(u) - centre) * inverse_f;
        const float X = R(0, 0) * x + R(0, 1) * y + R(0, 2) + t.x() * in[u];
        const float Y = R(1, 0) * x + R(1, 1) * y + R(1, 2) + t.y() * in[u];
        const float Z = R(2, 0) * x + R(2, 1) * y + R(2, 2) + t.z() * in[u];
        const float inverse_z = 1.0F / Z;
        u_out[u] = fx * X * inverse_z + cx;
        v_out[u] = fy * Y * inverse_z + cy;
      }
    }
  }

  void shift(const OutlineShifts& shifts) {
    if (shifts.nodes.empty()) return;
    for (int v = 0; v < u_.rows; ++v)
      for (int u = 0; u < u_.cols; ++u) {
        const cv::Vec2f by = shifts.at(u_(v, u), v_(v, u));
        u_(v, u) += by[0];
        v_(v, u) += by[1];
      }
  }

  /// An object nearer than the sensor's range hides what the colour camera has behind it, wherever
  /// between the least depth and half of it the object stands.
  void hide_behind_holes(cv::Mat1f& hit) const {
    const cv::Mat1b& hole = edges_.near_holes;
    if (cv::countNonZero(hole) == 0) return;
    Calibration mended = believed_;
    mended.T_color_depth.linear() =
        alignment_.rotation.cast<double>() * believed_.T_color_depth.linear();
    mended.T_color_depth.translation() =
        alignment_.rotation.cast<double>() * believed_.T_color_depth.translation() +
        alignment_.translation.cast<double>();
    for (const double share : {1.0, 0.85, 0.7, 0.6, 0.5}) {
      const double z_m = share * believed_.range_min_m;
      for (int v = 0; v < hole.rows; ++v)
        for (int u = 0; u < hole.cols; ++u) {
          if (!hole(v, u)) continue;
          const Eigen::Vector2d at =
              mended.color.project(mended.T_color_depth * mended.depth.back_project(u, v, z_m));
          const int c = static_cast<int>(at.x() + 0.5), r = static_cast<int>(at.y() + 0.5);
          if (c < 0 || r < 0 || c >= hit.cols || r >= hit.rows) continue;
          hit(r, c) = std::max(hit(r, c), static_cast<float>(1.0 / z_m));
        }
    }
  }

  /// Nearest surface by colour pixel, as inverse depth, spread over the neighbouring pixels.
  void find_nearest() {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1f hit(field_.owner.rows, field_.owner.cols, 0.0F);
    for (int v = 0; v < w.rows; ++v) {
      const float *in = w[v], *us = u_[v], *vs = v_[v];
      for (int u = 0; u < w.cols; ++u) {
        const int c = static_cast<int>(us[u] + 0.5F), r = static_cast<int>(vs[u] + 0.5F);
        if (c < 0 || r < 0 || c >= hit.cols || r >= hit.rows) continue;
        float& nearest = hit(r, c);
        if (in[u] > nearest) nearest = in[u];
      }
    }
    hide_behind_holes(hit);
    cv::dilate(hit, nearest_, cv::Mat(3, 3, CV_8U, cv::Scalar(1)));
  }

  Votes collect() {
    const cv::Mat1f& w = edges_.inverse_depth;
    const int beyond_px = static_cast<int>(std::ceil(1.5F * alignment_.offset_px));
    const cv::Mat1w owners =
        alignment_.offset_px > 0.5F ? spread_owners(field_.owner, beyond_px) : field_.owner;
    Votes votes{cv::Mat1w(w.rows, w.cols, std::uint16_t{0}), cv::Mat1f(w.rows, w.cols, -1e4F),
                cv::Mat1f(w.rows, w.cols, 0.0F)};
    for (int v = 0; v < w.rows; ++v) {
      const float *in = w[v], *us = u_[v], *vs = v_[v];
      std::uint16_t* owner = votes.owner[v];
      float *depth_in = votes.depth_in[v], *weight = votes.weight[v];
      for (int u = 0; u < w.cols; ++u) {
        if (!(in[u] > 0)) continue;
        const int c = static_cast<int>(us[u] + 0.5F), r = static_cast<int>(vs[u] + 0.5F);
        if (c < 0 || r < 0 || c >= owners.cols || r >= owners.rows) continue;
        owner[u] = owners(r, c);
        depth_in[u] = alignment_.offset_px - field_.distance(r, c);
        const float behind = nearest_(r, c) * (1.0F - kHidden) - kNoise * edges_.noise - in[u];
        if (behind > 0 && behind > kSlopes * slope_at(v, u)) {
          depth_in[u] = -1.0F, weight[u] = kHiddenVote;
          continue;
        }
        weight[u] = std::clamp(std::abs(depth_in[u]) / kSureAt_px, kLeastVote, 1.0F);
      }
    }
    close_slits(votes);
    return votes;
  }

 private:
  /// Where masks have been grown over slits of their objects, what lies behind is not the object.
  void close_slits(Votes& votes) const {
    if (alignment_.offset_px > -kGrown_px) return;
    const int widest_px = static_cast<int>(std::ceil(-2 * alignment_.offset_px));
    const cv::Mat1b slits = filled_slits(edges_, votes.owner, widest_px);
    votes.depth_in.setTo(-1.0F, slits);
    votes.weight.setTo(1.0F, slits);
  }

  /// How much the inverse depth of the surface of a pixel rises to the next, along its row or its
  /// column; of two neighbours on the surface the nearer in depth counts.
  [[nodiscard]] float slope_at(int v, int u) const {
    const cv::Mat1f& w = edges_.inverse_depth;
    const float here = w(v, u);
    const auto least = [&](bool before, float w_before, bool after, float w_after) {
      const float back = before ? std::abs(here - w_before) : 1.0F;
      const float on = after ? std::abs(w_after - here) : 1.0F;
      return before || after ? std::min(back, on) : 0.0F;
    };
    const auto next = [](float continuity) { return continuity >= 1.0F; };
    const bool left = u > 0 && next(edges_.right(v, u - 1)), right = next(edges_.right(v, u));
    const bool up = v > 0 && next(edges_.down(v - 1, u)), down = next(edges_.down(v, u));
    return std::max(least(left, left ? w(v, u - 1) : 0, right, right ? w(v, u + 1) : 0),
                    least(up, up ? w(v - 1, u) : 0, down, down ? w(v + 1, u) : 0));
  }

  const DepthEdges& edges_;
  const OutlineField& field_;
  const OutlineAlignment& alignment_;
  const Calibration& believed_;
  cv::Mat1f u_, v_, nearest_;
};

/// Recursive averages along rows and columns, which do not cross depth edges.
void smooth(cv::Mat2f& votes, const cv::Mat1f& right, const cv::Mat1f& down, float reach_px) {
  for (int round = 0; round < kRounds; ++round) {
    const float feedback = std::exp(-1.0F / (reach_px * std::pow(0.5F, static_cast<float>(round))));
    for (int v = 0; v < votes.rows; ++v) {
      cv::Vec2f* row = votes[v];
      const float* open = right[v];
      for (int u = 1; u < votes.cols; ++u) row[u] += feedback * open[u - 1] * row[u - 1];
      // what came from the left is in row[u]; the backward pass must not count the pixel twice
      for (int u = votes.cols - 2; u >= 0; --u) {
        const float a = feedback * open[u];
        row[u] = row[u] + a * (row[u + 1] - a * row[u]);
      }
    }
    for (int v = 1; v < votes.rows; ++v) {
      const cv::Vec2f* above = votes[v - 1];
      const float* open = down[v - 1];
      cv::Vec2f* row = votes[v];
      for (int u = 0; u < votes.cols; ++u) row[u] += feedback * open[u] * above[u];
    }
    for (int v = votes.rows - 2; v >= 0; --v) {
      const cv::Vec2f* below = votes[v + 1];
      const float* open = down[v];
      cv::Vec2f* row = votes[v];
      for (int u = 0; u < votes.cols; ++u) {
        const float a = feedback * open[u];
        row[u] = row[u] + a * (below[u] - a * row[u]);
      }
    }
  }
}

}  // namespace

cv::Mat1w vote_on_surfaces(const DepthEdges& edges, const OutlineField& field,
                           const OutlineAlignment& alignment, const OutlineShifts& shifts,
                           const Calibration& believed, std::size_t detections, double reach_px) {
  Voting voting(edges, field, alignment, believed);
  voting.project();
  voting.shift(shifts);
  voting.find_nearest();
  const Votes votes = voting.collect();
  const cv::Size size = votes.owner.size();
  cv::Mat1w labels(size, std::uint16_t{0});
  std::vector<cv::Rect> boxes(detections + 1);
  const int margin = static_cast<int>(std::ceil(2.0 * reach_px)) + 2;
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u)
      if (votes.depth_in(v, u) > 0 && votes.owner(v, u) != 0) {
        cv::Rect& box = boxes[votes.owner(v, u)];
        box = box.empty() ? cv::Rect(u, v, 1, 1) : box | cv::Rect(u, v, 1, 1);
      }
  for (std::size_t n = 1; n <= detections; ++n) {
    if (boxes[n].empty()) continue;
    const cv::Rect box = cv::Rect(boxes[n].x - margin, boxes[n].y - margin,
                                  boxes[n].width + 2 * margin, boxes[n].height + 2 * margin) &
                         cv::Rect({0, 0}, size);
    cv::Mat2f sums(box.size());
    for (int v = 0; v < box.height; ++v)
      for (int u = 0; u < box.width; ++u) {
        const int row = v + box.y, column = u + box.x;
        const float weight = votes.weight(row, column);
        const bool in_mask = votes.owner(row, column) != 0 && votes.depth_in(row, column) > 0;
        const bool inside = in_mask && votes.owner(row, column) == n;
        sums(v, u) = {inside ? weight : 0.0F, in_mask && !inside ? kOtherVote * weight : weight};
      }
    smooth(sums, edges.right(box), edges.down(box), static_cast<float>(reach_px));
    for (int v = 0; v < box.height; ++v)
      for (int u = 0; u < box.width; ++u)
        if (sums(v, u)[0] > kShare * sums(v, u)[1] && sums(v, u)[1] > 1e-4F &&
            edges.inverse_depth(v + box.y, u + box.x) > 0)
          labels(v + box.y, u + box.x) = static_cast<std::uint16_t>(n);
  }
  return labels;
}

}  // namespace mapscore
