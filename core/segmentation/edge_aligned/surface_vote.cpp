// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_vote.hpp"

#include "core/segmentation/edge_aligned/pixel_votes.hpp"
#include "core/segmentation/edge_aligned/surface_average.hpp"
#include "core/wide_vectors.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

constexpr float kShare = 0.8F;        // of the votes; only where a surface goes on does it trim
constexpr float kLeastVotes = 1e-4F;  // that reach a pixel
/// Of a vote for another object: the share is reached by half of two objects' votes.
constexpr float kOtherVote = (1 - kShare) / kShare;

/// The votes of some pixels for detection `own`, and those for and against it.
MAPSCORE_WIDE_VECTORS
void split_votes(const std::uint16_t* owner, const float* weight, std::uint16_t own, int count,
                 float* __restrict own_votes, float* __restrict all_votes) {
  for (int u = 0; u < count; ++u) {
    own_votes[u] = owner[u] == own ? weight[u] : 0.0F;
    all_votes[u] = (owner[u] != 0) & (owner[u] != own) ? kOtherVote * weight[u] : weight[u];
  }
}

/// Labels the pixels that have a depth where its own votes are enough of all.
MAPSCORE_WIDE_VECTORS
void label_row(const float* own_votes, const float* all_votes, const float* w, std::uint16_t own,
               int count, std::uint16_t* __restrict labels) {
  for (int u = 0; u < count; ++u) {
    const bool is_own =
        (own_votes[u] > kShare * all_votes[u]) & (all_votes[u] > kLeastVotes) & (w[u] > 0);
    labels[u] = is_own ? own : labels[u];
  }
}

/// The pixels of each owner.
std::vector<cv::Rect> extents_of(const cv::Mat1w& owners, std::size_t detections) {
  std::vector<cv::Rect> extents(detections + 1);
  for (int v = 0; v < owners.rows; ++v) {
    const std::uint16_t* owner = owners[v];
    for (int u = 0, begin = 0; u < owners.cols; begin = u) {
      while (u < owners.cols && owner[u] == owner[begin]) ++u;
      if (owner[begin] != 0) extents[owner[begin]] |= cv::Rect(begin, v, u - begin, 1);
    }
  }
  return extents;
}

}  // namespace

cv::Mat1w vote_on_surfaces(const DepthEdges& edges, const OutlineField& field,
                           const OutlineAlignment& alignment, const OutlineShifts& shifts,
                           const Calibration& believed, std::size_t detections,
                           const Continuity& on, double reach_px) {
  const PixelVotes votes = pixel_votes(edges, field, alignment, shifts, believed, detections);
  const cv::Size size = votes.owner.size();
  cv::Mat1w labels(size, std::uint16_t{0});
  const std::vector<cv::Rect> extents = extents_of(votes.owner, detections);
  const int margin = static_cast<int>(std::ceil(2.0 * reach_px)) + 2;
  for (std::size_t n = 1; n <= detections; ++n) {
    if (extents[n].empty()) continue;
    const auto own = static_cast<std::uint16_t>(n);
    const cv::Rect box = cv::Rect(extents[n].x - margin, extents[n].y - margin,
                                  extents[n].width + 2 * margin, extents[n].height + 2 * margin) &
                         cv::Rect({0, 0}, size);
    cv::Mat1f own_votes(box.size()), all_votes(box.size());
    for (int v = 0; v < box.height; ++v)
      split_votes(votes.owner[v + box.y] + box.x, votes.weight[v + box.y] + box.x, own, box.width,
                  own_votes[v], all_votes[v]);
    for (cv::Mat1f* some : {&own_votes, &all_votes})
      average_on_surfaces(*some, on.right(box), on.down(box), static_cast<float>(reach_px));
    for (int v = 0; v < box.height; ++v)
      label_row(own_votes[v], all_votes[v], edges.inverse_depth[v + box.y] + box.x, own, box.width,
                labels[v + box.y] + box.x);
  }
  return labels;
}

}  // namespace mapscore
