// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/edge_aligned/surface_vote.hpp"

#include "core/segmentation/edge_aligned/pixel_votes.hpp"
#include "core/segmentation/edge_aligned/surface_average.hpp"
#include "core/wide_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mapscore {
namespace {

/// Against a mask, in votes for another: an object takes four fifths of what it shares with none.
constexpr float kNoMask = 4.0F;
constexpr float kLeastLead = 1e-4F;  // of votes that reach a pixel
constexpr double kMargin = 2.0;      // reaches: farther inside of its object a pixel needs no vote

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

/// Labels the pixels where an object leads, and takes its label from the others. Those without
/// depth have no label.
MAPSCORE_WIDE_VECTORS
void label_row(const float* leads, const float* w, std::uint16_t own, int count,
               std::uint16_t* __restrict labels) {
  for (int u = 0; u < count; ++u) {
    const std::uint16_t other = labels[u] == own ? std::uint16_t{0} : labels[u];
    const bool is_own = (leads[u] > kLeastLead) & (w[u] > 0);
    labels[u] = is_own ? own : other;
  }
}

/// Marks the pixels whose owner is not that of the pixel before or above.
MAPSCORE_WIDE_VECTORS
void mark_changes(const std::uint16_t* above, const std::uint16_t* owner, int count,
                  std::uint8_t* __restrict marks) {
  marks[0] = static_cast<std::uint8_t>(owner[0] != above[0]);
  for (int u = 1; u < count; ++u)
    marks[u] = static_cast<std::uint8_t>((owner[u] != owner[u - 1]) | (owner[u] != above[u]));
}

/// Where each detection's votes meet others: blocks of kBlock_px columns and kBand_px rows that
/// come within `margin_px` of a pixel where its object begins or ends, as far as they lie in the
/// box about all of these. Finding them parts `on` at contacts of two masks, where their surface
/// plainly goes on: the masks decide there, and no votes meet. So it does at steps between two
/// masks, however small.
class ContestedBlocks {
 public:
  ContestedBlocks(const cv::Mat1w& owners, std::size_t detections, int margin_px, Continuity& on)
      : size_(owners.size()),
        margin_px_(margin_px),
        columns_((owners.cols + kBlock_px - 1) / kBlock_px),
        bands_((owners.rows + kBand_px - 1) / kBand_px),
        marks_((detections + 1) * blocks(), 0),
        boxes_(detections + 1) {
    Marks changes(static_cast<std::size_t>(owners.cols));
    std::vector<float*> parted;
    for (int v = 0; v < owners.rows; ++v) {
      mark_changes(owners[std::max(v - 1, 0)], owners[v], owners.cols, changes.data());
      const auto meet = [&](const cv::Point& at, const cv::Point& before, cv::Mat1f& open) {
        const std::uint16_t own = owners(at), other = owners(before);
        if (own == other) return;
        const bool are_masks = own != 0 && other != 0;
        const bool is_contact = are_masks && goes_on(open, before, at - before);
        if (is_contact || (are_masks && open(before) < 1.0F)) parted.push_back(&open(before));
        if (!is_contact) mark(own, at), mark(other, at);
      };
      for_each_marked(changes, [&](int u) {
        if (u > 0) meet({u, v}, {u - 1, v}, on.right);
        if (v > 0) meet({u, v}, {u, v - 1}, on.down);
      });
    }
    for (float* const open : parted) *open = 0.0F;  // at last: goes_on looks beside each pair
  }

  /// The blocks of a detection, those beside each other as one, in order of bands.
  [[nodiscard]] std::vector<cv::Rect> parts_of(std::size_t number) const {
    std::vector<cv::Rect> parts;
    const cv::Rect box = boxes_[number] & cv::Rect({0, 0}, size_);
    const std::uint8_t* row = marks_.data() + number * blocks();
    for (int band = 0; band < bands_; ++band, row += columns_)
      for (int begin = 0, end = 0; begin < columns_; begin = end + 1) {
        end = begin;
        while (end < columns_ && row[end] != 0) ++end;
        const cv::Rect run(kBlock_px * begin, kBand_px * band, kBlock_px * (end - begin), kBand_px);
        if (begin < end) parts.push_back(run & box);
      }
    return parts;
  }

 private:
  static constexpr int kBlock_px = 16;

  [[nodiscard]] std::size_t blocks() const { return static_cast<std::size_t>(columns_ * bands_); }

  /// Whether a surface goes on from `before` by `step` to the next pixel, to it from the one before
  /// and from there to the one after, as far as these lie in the image.
  [[nodiscard]] static bool goes_on(const cv::Mat1f& open, const cv::Point& before,
                                    const cv::Point& step) {
    const cv::Rect image({0, 0}, open.size());
    const cv::Point first = before - step, last = before + step;
    return open(before) >= 1.0F && (!image.contains(first) || open(first) >= 1.0F) &&
           (!image.contains(last + step) || open(last) >= 1.0F);
  }

  void mark(std::uint16_t owner, const cv::Point& at) {
    if (owner == 0) return;
    const cv::Rect about(at.x - margin_px_, at.y - margin_px_, 2 * margin_px_, 2 * margin_px_);
    boxes_[owner] |= about;
    std::uint8_t* const marks = marks_.data() + owner * blocks();
    const int left = std::max(about.x, 0) / kBlock_px,
              right = std::min(about.br().x - 1, size_.width - 1) / kBlock_px,
              top = std::max(about.y, 0) / kBand_px,
              bottom = std::min(about.br().y - 1, size_.height - 1) / kBand_px;
    for (int band = top; band <= bottom; ++band)
      for (int block = left; block <= right; ++block) marks[band * columns_ + block] = 1;
  }

  cv::Size size_;
  int margin_px_, columns_, bands_;
  std::vector<std::uint8_t> marks_;  ///< by detection and block
  std::vector<cv::Rect> boxes_;
};

}  // namespace

cv::Mat1w vote_on_surfaces(const DepthEdges& edges, const MaskField& masks,
                           const OutlineAlignment& alignment, const OutlineShifts& shifts,
                           const Calibration& believed, std::size_t detections, Continuity& on,
                           double reach_px) {
  const PixelVotes votes = pixel_votes(edges, masks, alignment, shifts, believed, detections);
  cv::Mat1w labels = votes.owner.clone();
  const int margin_px = static_cast<int>(std::ceil(kMargin * reach_px)) + 2;
  const ContestedBlocks contested(votes.owner, detections, margin_px, on);
  cv::Mat1f leads(labels.size());
  for (std::size_t n = 1; n <= detections; ++n) {
    const auto own = static_cast<std::uint16_t>(n);
    const std::vector<cv::Rect> parts = contested.parts_of(n);
    for (const cv::Rect& part : parts)
      for (int v = part.y; v < part.br().y; ++v)
        find_leads(votes.owner[v] + part.x, votes.weight[v] + part.x, own, part.width,
                   leads[v] + part.x);
    average_on_surfaces(leads, parts, on.right, on.down, static_cast<float>(reach_px));
    for (const cv::Rect& part : parts)
      for (int v = part.y; v < part.br().y; ++v)
        label_row(leads[v] + part.x, edges.inverse_depth[v] + part.x, own, part.width,
                  labels[v] + part.x);
  }
  return labels;
}

}  // namespace mapscore
