// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/pixel_votes.hpp"

#include "core/segmentation/edge_aligned/color_places.hpp"
#include "core/segmentation/edge_aligned/filled_slits.hpp"
#include "core/segmentation/edge_aligned/unseen_occluders.hpp"
#include "core/wide_vectors.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mapscore {
namespace {

constexpr float kHidden = 0.015F;   // share of inverse depth by which a hidden pixel lies behind
constexpr float kSlopes = 2.0F;     // pixels that a surface may rise by itself
constexpr float kNoise = 4.0F;      // sigmas that it may be off
constexpr float kSureAt_px = 2.0F;  // from the outline a pixel's vote has full weight
constexpr float kLeastVote = 0.05F;
constexpr float kHiddenVote = 0.2F;   // against every object
constexpr float kGrown_px = 0.5F;     // from here on masks may have filled slits
constexpr float kFree_px = 0.5F;      // what no mask holds begins half a pixel before its centre
constexpr float kOutside_px = -1e4F;  // of what the colour camera does not see

// A surface moves before the one that it hides along a side of the baseline that is so many pixels,
// of a point at 1 m, and so much of the other side; less is chance.
constexpr double kLeastMove_px = 3.0, kLeastOfOther = 0.5;
constexpr double kSamePitch = 0.02;    // a gap in fifty rows is none
constexpr double kWidestPitch = 64.0;  // of depth pixels in the colour image, whose gaps are closed

/// By how much more than noise a surface lies behind the nearest one of its colour pixel, 1/m.
float behind(float nearest, float noise, float w) {
  return nearest * (1.0F - kHidden) - kNoise * noise - w;
}

/// By how many pixels of a row or column of the colour image a surface is spread to either side, if
/// it moves that way by `move_px` and the other way by `other_px`, and depth pixels beside each
/// other lie `pitch` pixels apart.
int spread_px(double move_px, double other_px, double pitch) {
  const bool moves = move_px >= kLeastMove_px && move_px >= kLeastOfOther * other_px;
  const double gap = (std::min(pitch, kWidestPitch) - 1.0 - kSamePitch) / 2.0;
  return std::max(static_cast<int>(std::ceil(gap)), moves ? 1 : 0);
}

/// Some depth pixels in a row: inverse depth, 1/m, 0 where there is none, and place in a colour
/// image, -1 beyond it.
struct PixelRow {
  const float* w;
  const int* cells;
  int count;

  [[nodiscard]] bool is_seen(int u) const { return (w[u] > 0) & (cells[u] >= 0); }
};

/// Keeps the largest inverse depth w of each place of an image, by the runs of a row.
MAPSCORE_WIDE_VECTORS
void keep_nearest(const float* w, std::span<const ColorPlaces::Run> runs,
                  float* __restrict nearest) {
  for (const auto& [begin, count, cell] : runs)
    for (int n = 0; n < count; ++n) {
      const float last = nearest[cell + n], here = w[begin + n];
      nearest[cell + n] = here > last ? here : last;
    }
}

/// How far they lie inside of outlines `distance` px away from them that mended masks have moved
/// outwards by `offset_px`. Takes the owner from those that are not seen.
MAPSCORE_WIDE_VECTORS
void find_depth_in(PixelRow row, const float* distance, float offset_px, float* __restrict depth_in,
                   std::uint16_t* __restrict owner) {
  const int count = row.count;
  for (int u = 0; u < count; ++u) {
    const bool is_seen = row.is_seen(u);
    depth_in[u] = is_seen ? offset_px - distance[u] : kOutside_px;
    owner[u] = is_seen ? owner[u] : std::uint16_t{0};
  }
}

/// What their votes weigh as far as they are seen. Marks those that something near covers, or whose
/// colour pixel has a `nearest` surface nearer by more than noise.
MAPSCORE_WIDE_VECTORS
void weigh(PixelRow row, const float* depth_in, const float* nearest, const std::uint8_t* covered,
           float noise, float* __restrict weight, std::uint8_t* __restrict may_be_hidden) {
  const int count = row.count;
  for (int u = 0; u < count; ++u) {
    const float share = std::abs(depth_in[u]) / kSureAt_px;
    const float limited = share < kLeastVote ? kLeastVote : share > 1.0F ? 1.0F : share;
    const bool is_seen = row.is_seen(u);
    const bool is_behind = behind(nearest[u], noise, row.w[u]) > 0;
    weight[u] = is_seen ? limited : 0.0F;
    may_be_hidden[u] = static_cast<std::uint8_t>(is_seen & (is_behind | (covered[u] != 0)));
  }
}

/// Takes the owner from pixels that do not lie inside of its object.
MAPSCORE_WIDE_VECTORS
void leave_out(const float* depth_in, int count, std::uint16_t* __restrict owner) {
  for (int u = 0; u < count; ++u) owner[u] = depth_in[u] > 0 ? owner[u] : std::uint16_t{0};
}

class Voting {
 public:
  Voting(const DepthEdges& edges, const MaskField& masks, const OutlineAlignment& alignment,
         const OutlineShifts& shifts, const Calibration& believed, std::size_t detections)
      : edges_(edges),
        masks_(masks),
        alignment_(alignment),
        detections_(detections),
        mended_(alignment.corrected(believed)),
        places_(color_places(edges.inverse_depth, mended_, shifts)) {}

  [[nodiscard]] PixelVotes collect() const {
    const cv::Mat1f &w = edges_.inverse_depth, near = nearest_surfaces();
    const cv::Mat1b behind_unseen = unseen_occluders(edges_, places_, masks_, alignment_, mended_);
    const int beyond_px = static_cast<int>(std::ceil(1.5F * alignment_.offset_px));
    const cv::Mat1w owners =
        alignment_.offset_px > 0.5F ? spread_owners(masks_.owner, beyond_px) : masks_.owner;
    PixelVotes votes{cv::Mat1w(w.rows, w.cols), cv::Mat1f(w.rows, w.cols)};
    const bool may_have_slits = alignment_.offset_px <= -kGrown_px;
    // Owners as the masks have them, before what lies outside of the mended ones is left out.
    cv::Mat1w grown = may_have_slits ? cv::Mat1w(w.rows, w.cols) : cv::Mat1w();
    const cv::Mat1f to_free = distance_to_free();
    std::vector<float> distance(static_cast<std::size_t>(w.cols)), nearest(distance.size()),
        depths_in(distance.size());
    Marks may_be_hidden(distance.size());
    float* const depth_in = depths_in.data();
    for (int v = 0; v < w.rows; ++v) {
      const PixelRow row{w[v], places_.cells()[v], w.cols};
      float* const weight = votes.weight[v];
      std::uint16_t* const owner = votes.owner[v];
      places_.look_up(owners[0], v, owner);
      places_.look_up(masks_.distance[0], v, distance.data());
      places_.look_up(near[0], v, nearest.data());
      find_depth_in(row, distance.data(), alignment_.offset_px, depth_in, owner);
      if (!to_free.empty()) hold_borders(row, to_free[0], distance.data(), depth_in);
      const std::uint8_t* covered = behind_unseen[v];
      weigh(row, depth_in, nearest.data(), covered, edges_.noise, weight, may_be_hidden.data());
      for_each_marked(may_be_hidden, [&](int u) {
        const float w_nearest = nearest[static_cast<std::size_t>(u)];
        const bool is_hidden = behind(w_nearest, edges_.noise, row.w[u]) > kSlopes * slope_at(v, u);
        if (covered[u] != 0 || is_hidden) depth_in[u] = -1.0F, weight[u] = kHiddenVote;
      });
      if (may_have_slits) std::copy(owner, owner + w.cols, grown[v]);
      leave_out(depth_in, w.cols, owner);
    }
    if (may_have_slits) close_slits(grown, votes);
    return votes;
  }

 private:
  /// Nearest surface by colour pixel, as inverse depth. It is spread by a pixel along the baseline,
  /// where a surface moves before the one that it hides, and over the gaps between depth pixels.
  [[nodiscard]] cv::Mat1f nearest_surfaces() const {
    const cv::Mat1f& w = edges_.inverse_depth;
    cv::Mat1f hit(masks_.owner.size(), 0.0F), spread;
    for (int v = 0; v < w.rows; ++v) keep_nearest(w[v], places_.runs_of(v), hit[0]);
    const CameraModel &color = mended_.color, &depth = mended_.depth;
    const Eigen::Vector3d& t = mended_.T_color_depth.translation();
    const double right_px = color.fx_px * std::abs(t.x()), down_px = color.fy_px * std::abs(t.y());
    const int wide = spread_px(right_px, down_px, color.fx_px / depth.fx_px);
    const int high = spread_px(down_px, right_px, color.fy_px / depth.fy_px);
    cv::dilate(hit, spread, cv::Mat(2 * high + 1, 2 * wide + 1, CV_8U, cv::Scalar(1)));
    return spread;
  }

  /// By colour pixel, how far it is from what no mask holds; empty unless there are some masks that
  /// are too large.
  [[nodiscard]] cv::Mat1f distance_to_free() const {
    cv::Mat1f distance;
    if (detections_ > 1 && alignment_.offset_px < -kGrown_px)
      cv::distanceTransform(masks_.owner != 0, distance, cv::DIST_L2, cv::DIST_MASK_3);
    return distance;
  }

  /// A border of two masks stays where it is when both shrink. `distance`: of each pixel of the row
  /// from its mask's outline.
  void hold_borders(const PixelRow& row, const float* to_free, const float* distance,
                    float* depth_in) const {
    for (int u = 0; u < row.count; ++u)
      if (row.is_seen(u) && depth_in[u] <= 0 &&
          to_free[row.cells[u]] > kFree_px - alignment_.offset_px)
        depth_in[u] = -distance[u];
  }

  /// Where masks have been grown over slits of their objects, what lies behind is not the object.
  void close_slits(const cv::Mat1w& grown, PixelVotes& votes) const {
    const int widest_px = static_cast<int>(std::ceil(-2 * alignment_.offset_px));
    const cv::Mat1b slits = filled_slits(edges_, grown, widest_px);
    votes.owner.setTo(0, slits);
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
  const MaskField& masks_;
  const OutlineAlignment& alignment_;
  std::size_t detections_;
  Calibration mended_;
  ColorPlaces places_;
};

}  // namespace

PixelVotes pixel_votes(const DepthEdges& edges, const MaskField& masks,
                       const OutlineAlignment& alignment, const OutlineShifts& shifts,
                       const Calibration& believed, std::size_t detections) {
  return Voting(edges, masks, alignment, shifts, believed, detections).collect();
}

}  // namespace mapscore
