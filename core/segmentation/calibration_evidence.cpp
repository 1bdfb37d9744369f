// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"

#include <algorithm>
#include <utility>

namespace mapscore {
namespace {

constexpr double kLeastOfOthers_px = 100;  // of outline that corrections explain in other frames
constexpr double kStands = 0.6;            // of that, what is explained without them,
constexpr double kAsMuch = 0.95;           // and of what the frame's own correction explains there
constexpr double kLeastOfMended = 0.15;    // of what a frame's own correction explains in itself,
constexpr double kMostGain_px = 500;       // and outline that it explains beyond: then it moved

/// No frame fits better as believed than with its own correction.
double as_believed_px(const FittedFrame& frame) {
  return std::min(frame.believed_px(), frame.mended_px());
}

/// The same view, as of a robot that stands, has the same chances.
bool is_same(const FittedFrame& a, const FittedFrame& b) {
  return a.mended_px() == b.mended_px() && a.believed_px() == b.believed_px();
}

}  // namespace

void CalibrationEvidence::add(std::shared_ptr<const FittedFrame> frame) {
  if (is_closed_ || !frame) return;
  if (added_++ % step_ == 0) frames_.push_back(std::move(frame));
  if (frames_.size() <= kMostFrames) return;
  for (std::size_t n = 0; 2 * n < frames_.size(); ++n) frames_[n] = frames_[2 * n];
  frames_.resize((frames_.size() + 1) / 2);
  step_ *= 2;
}

bool CalibrationEvidence::stands_in(const FittedFrame& frame) const {
  if (frame.believed_px() <= kLeastOfMended * frame.mended_px() ||
      frame.mended_px() - frame.believed_px() >= kMostGain_px)
    return false;
  double mended_px = 0, believed_px = 0, by_this_px = 0;
  for (const auto& other : frames_) {
    if (is_same(*other, frame)) continue;
    mended_px += other->mended_px();
    believed_px += as_believed_px(*other);
  }
  if (mended_px < kLeastOfOthers_px || believed_px < kStands * mended_px) return false;
  for (const auto& other : frames_)
    if (!is_same(*other, frame))
      by_this_px += std::min(other->explained_px(frame), other->mended_px());
  return believed_px >= kAsMuch * by_this_px;
}

}  // namespace mapscore
