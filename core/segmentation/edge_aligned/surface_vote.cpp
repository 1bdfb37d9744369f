// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_vote.hpp"

#include "core/segmentation/edge_aligned/edge_matching.hpp"
#include "core/segmentation/edge_aligned/filled_slits.hpp"
#include "core/segmentation/edge_aligned/settled_depth.hpp"
#include "core/segmentation/edge_aligned/surface_average.hpp"
#include "core/segmentation/edge_aligned/unseen_occluders.hpp"
#include "core/wide_vectors.hpp"

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
constexpr float kFree_px = 0.5F;     // what no mask holds begins half a pixel before its centre
constexpr float kShare = 0.8F;       // of the votes; only where a surface goes on does it trim
/// Of a vote for another object: the share is reached by half of two objects' votes.
constexpr float kOtherVote = (1 - kShare) / kShare;

/// What the masks say of each depth pixel.
struct Votes {
  cv::Mat1w owner;     ///< 1 + detection whose mask is nearest
  cv::Mat1f depth_in;  ///< pixels inside its object, negative outside
  cv::Mat1f weight;    ///< little where the colour camera does not see the surface
};

/// From a depth pixel to the colour image.
struct RayMotion {
  Eigen::Matrix3f R;
  Eigen::Vector3f t;
  Projection color, depth;
};

/// Projects the pixels of a row of inverse depths w: with p = z ray, p_color / z = R ray + t w.
MAPSCORE_WIDE_VECTORS
void project_row(const RayMotion& motion, int v, const float* w, int columns, float* us,
                 float* vs) {
  const Eigen::Matrix3f& R = motion.R;
  const Projection &color = motion.color, &depth = motion.depth;
  const float y = (static_cast<float>(v) - depth.cy) / depth.fy, inverse_f = 1.0F / depth.fx;
  const float xx = R(0, 0), xy = R(0, 1) * y, xz = R(0, 2), yx = R(1, 0), yy = R(1, 1) * y,
              yz = R(1, 2), zx = R(2, 0), zy = R(2, 1) * y, zz = R(2, 2);
  const float tx = motion.t.x(), ty = motion.t.y(), tz = motion.t.z();
  const float fx = color.fx, fy = color.fy, cx = color.cx, cy = color.cy, centre = depth.cx;
  for (int u = 0; u < columns; ++u) {
    const float x = (static_cast<float>(u) - centre) * inverse_f;
    const float X = xx * x + xy + xz + tx * w[u];
    const float Y = yx * x + yy + yz + ty * w[u];
    const float Z = zx * x + zy + zz + tz * w[u];
    const float inverse_z = 1.0F / Z;
    us[u] = fx * X * inverse_z + cx;
    vs[u] = fy * Y * inverse_z + cy;
  }
}

/// The pixels of an image, row-major, that hold some places; -1 beyond it.
MAPSCORE_WIDE_VECTORS
void find_pixels(const float* us, const float* vs, int count, const cv::Size& image, int* pixels) {
  const int columns = image.width;
  const float right = static_cast<float>(columns), bottom = static_cast<float>(image.height);
  for (int n = 0; n < count; ++n) {
    const float u = us[n] + 0.5F, v = vs[n] + 0.5F;
    const bool within = (u >= 0) & (v >= 0) & (u < right) & (v < bottom);
    const int column = static_cast<int>(within ? u : 0.0F);
    const int row = static_cast<int>(within ? v : 0.0F);
    pixels[n] = within ? row * columns + column : -1;
  }
}

class Voting {
 public:
  Voting(const DepthEdges& edges, const OutlineField& field, const OutlineAlignment& alignment,
         const Calibration& believed, std::size_t detections)
      : edges_(edges),
        field_(field),
        alignment_(alignment),
        believed_(believed),
        detections_(detections) {}

  /// Finds the colour pixel that each depth pixel lies in.
  void locate(const OutlineShifts& shifts) {
    const cv::Mat1f& w = edges_.inverse_depth;
    cells_.create(w.rows, w.cols);
    const Eigen::Isometry3f T_color_depth = alignment_.corrected(believed_.T_color_depth);
    const RayMotion motion{T_color_depth.linear(), T_color_depth.translation(),
                           Projection(believed_.color), Projection(believed_.depth)};
    std::vector<float> us(static_cast<std::size_t>(w.cols)), vs(us.size());
    for (int v = 0; v < w.rows; ++v) {
      project_row(motion, v, w[v], w.cols, us.data(), vs.data());
      if (!shifts.nodes.empty())
        for (std::size_t u = 0; u < us.size(); ++u) {
          const cv::Vec2f by = shifts.at(us[u], vs[u]);
          us[u] += by[0], vs[u] += by[1];
        }
      find_pixels(us.data(), vs.data(), w.cols, field_.masks.size(), cells_[v]);
    }
  }

  /// Nearest surface by colour pixel, as inverse depth, spread over the neighbouring pixels.
  void find_nearest() {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1f hit(field_.masks.rows, field_.masks.cols, 0.0F);
    float* const hits = hit[0];
    for (int v = 0; v < w.rows; ++v) {
      const float* in = w[v];
      const int* cells = cells_[v];
      for (int u = 0; u < w.cols; ++u)
        if (cells[u] >= 0 && in[u] > hits[cells[u]]) hits[cells[u]] = in[u];
    }
    cv::dilate(hit, nearest_, cv::Mat(3, 3, CV_8U, cv::Scalar(1)));
    behind_unseen_ = unseen_occluders(edges_, cells_, field_, alignment_, believed_);
  }

  Votes collect() {
    const cv::Mat1f& w = edges_.inverse_depth;
    const int beyond_px = static_cast<int>(std::ceil(1.5F * alignment_.offset_px));
    const cv::Mat1w owners =
        alignment_.offset_px > 0.5F ? spread_owners(field_.masks, beyond_px) : field_.masks;
    Votes votes{cv::Mat1w(w.rows, w.cols, std::uint16_t{0}), cv::Mat1f(w.rows, w.cols, -1e4F),
                cv::Mat1f(w.rows, w.cols, 0.0F)};
    const std::uint16_t* const owner_of = owners[0];
    const float *const distance = field_.mask_distance[0], *const nearest = nearest_[0];
    const cv::Mat1f distances = distance_to_free();
    const float* const to_free = distances.empty() ? nullptr : distances[0];
    for (int v = 0; v < w.rows; ++v) {
      const float* in = w[v];
      const int* cells = cells_[v];
      std::uint16_t* owner = votes.owner[v];
      float *depth_in = votes.depth_in[v], *weight = votes.weight[v];
      const std::uint8_t* behind_unseen = behind_unseen_[v];
      for (int u = 0; u < w.cols; ++u) {
        const int cell = cells[u];
        if (!(in[u] > 0) || cell < 0) continue;
        owner[u] = owner_of[cell];
        depth_in[u] = alignment_.offset_px - distance[cell];
        // A border of two masks stays where it is when both shrink.
        if (to_free != nullptr && depth_in[u] <= 0 &&
            to_free[cell] > kFree_px - alignment_.offset_px)
          depth_in[u] = -distance[cell];
        const float behind = nearest[cell] * (1.0F - kHidden) - kNoise * edges_.noise - in[u];
        const bool hidden = behind > 0 && behind > kSlopes * slope_at(v, u);
        if (hidden || behind_unseen[u] != 0) {
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
  /// By colour pixel, how far it is from what no mask holds; empty unless there are some masks that
  /// are too large.
  [[nodiscard]] cv::Mat1f distance_to_free() const {
    cv::Mat1f distance;
    if (detections_ > 1 && alignment_.offset_px < -kGrown_px)
      cv::distanceTransform(field_.masks != 0, distance, cv::DIST_L2, cv::DIST_MASK_3);
    return distance;
  }

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
  std::size_t detections_;
  cv::Mat1i cells_;  ///< by depth pixel: place in a colour image, row-major; -1 beyond it
  cv::Mat1f nearest_;
  cv::Mat1b behind_unseen_;  ///< by depth pixel, 255 or 0
};

}  // namespace

cv::Mat1w vote_on_surfaces(const DepthEdges& edges, const OutlineField& field,
                           const OutlineAlignment& alignment, const OutlineShifts& shifts,
                           const Calibration& believed, std::size_t detections,
                           const Continuity& on, double reach_px) {
  Voting voting(edges, field, alignment, believed, detections);
  voting.locate(shifts);
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
    cv::Mat1f own(box.size()), all(box.size());
    for (int v = 0; v < box.height; ++v) {
      const std::uint16_t* owner = votes.owner[v + box.y] + box.x;
      const float* depth_in = votes.depth_in[v + box.y] + box.x;
      const float* weight = votes.weight[v + box.y] + box.x;
      float *own_vote = own[v], *all_votes = all[v];
      for (int u = 0; u < box.width; ++u) {
        const bool in_mask = owner[u] != 0 && depth_in[u] > 0;
        const bool inside = in_mask && owner[u] == n;
        own_vote[u] = inside ? weight[u] : 0.0F;
        all_votes[u] = in_mask && !inside ? kOtherVote * weight[u] : weight[u];
      }
    }
    average_on_surfaces(own, on.right(box), on.down(box), static_cast<float>(reach_px));
    average_on_surfaces(all, on.right(box), on.down(box), static_cast<float>(reach_px));
    for (int v = 0; v < box.height; ++v) {
      const float *own_share = own[v], *all_share = all[v];
      const float* w = edges.inverse_depth[v + box.y] + box.x;
      std::uint16_t* label = labels[v + box.y] + box.x;
      for (int u = 0; u < box.width; ++u)
        if (own_share[u] > kShare * all_share[u] && all_share[u] > 1e-4F && w[u] > 0)
          label[u] = static_cast<std::uint16_t>(n);
    }
  }
  return labels;
}

}  // namespace mapscore
