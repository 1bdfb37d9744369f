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

/// Against a mask, in votes for another: an object takes four fifths of what it shares with none.
constexpr float kNoMask = 4.0F;
constexpr float kLeastLead = 1e-4F;  // of votes that reach a pixel

/// What the votes of some pixels count for detection `own`: as they are for it, negative for other
/// masks and for none. It leads where an average of these is positive.
MAPSCORE_WIDE_VECTORS
void find_leads(const std::uint16_t* owner, const float* weight, std::uint16_t own, int count,
                float* __restrict leads) {
  for (int u = 0; u < count; ++u) {
    const float against = owner[u] != 0 ? -1.0F : -kNoMask;
    leads[u] = weight[u] * (owner[u] == own ? 1.0F : against);
  }
}

/// Labels the pixels that have a depth where an object leads.
MAPSCORE_WIDE_VECTORS
void label_row(const float* leads, const float* w, std::uint16_t own, int count,
               std::uint16_t* __restrict labels) {
  for (int u = 0; u < count; ++u) {
    const bool is_own = (leads[u] > kLeastLead) & (w[u] > 0);
    labels[u] = is_own ? own : labels[u];
  }
}

/// Marks the pixels whose owner is not the one before, and the first.
MAPSCORE_WIDE_VECTORS
void mark_changes(const std::uint16_t* owner, int count, std::uint8_t* __restrict marks) {
  marks[0] = 1;
  for (int u = 1; u < count; ++u) marks[u] = static_cast<std::uint8_t>(owner[u] != owner[u - 1]);
}

/// The pixels of each owner.
std::vector<cv::Rect> extents_of(const cv::Mat1w& owners, std::size_t detections) {
  std::vector<cv::Rect> extents(detections + 1);
  Marks changes(static_cast<std::size_t>(owners.cols));
  for (int v = 0; v < owners.rows; ++v) {
    const std::uint16_t* owner = owners[v];
    mark_changes(owner, owners.cols, changes.data());
    int begin = 0;
    const auto end_at = [&](int u) {
      if (owner[begin] != 0) extents[owner[begin]] |= cv::Rect(begin, v, u - begin, 1);
      begin = u;
    };
    for_each_marked(changes, end_at);
    end_at(owners.cols);
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
    cv::Mat1f leads(box.size());
    for (int v = 0; v < box.height; ++v)
      find_leads(votes.owner[v + box.y] + box.x, votes.weight[v + box.y] + box.x, own, box.width,
                 leads[v]);
    average_on_surfaces(leads, on.right(box), on.down(box), static_cast<float>(reach_px));
    for (int v = 0; v < box.height; ++v)
      label_row(leads[v], edges.inverse_depth[v + box.y] + box.x, own, box.width,
                labels[v + box.y] + box.x);
  }
  return labels;
}

}  // namespace mapscore
