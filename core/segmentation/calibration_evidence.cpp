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
constexpr double kShared = 0.5;            // of that, what a correction explains that serves all,
constexpr double kFarMore = 1.5;           // and over what is explained otherwise
constexpr double kLeastOfMended = 0.15;    // of what a frame's own correction explains in itself,
constexpr double kMostGain_px = 500;       // and outline that it explains beyond: then it moved

/// The same view, as of a robot that stands, has the same chances.
bool is_same(const FittedFrame& a, const FittedFrame& b) {
  return a.mended_px() == b.mended_px() && a.believed_px() == b.believed_px();
}

/// Whether a frame can have moved no farther than another calibration leaves it, which explains so
/// much of it.
bool may_serve(const FittedFrame& frame, double explained_px) {
  return explained_px > kLeastOfMended * frame.mended_px() &&
         frame.mended_px() - explained_px < kMostGain_px;
}

}  // namespace

void CalibrationEvidence::Kept::try_on(const FittedFrame& other) {
  if (is_same(*frame, other)) return;
  others_px += other.mended_px();
  explained_px += std::min(other.explained_px(*frame), other.mended_px());
}

void CalibrationEvidence::keep(std::shared_ptr<const FittedFrame> frame) {
  Kept kept{std::move(frame)};
  for (Kept& other : frames_) {
    kept.try_on(*other.frame);
    other.try_on(*kept.frame);
  }
  frames_.push_back(std::move(kept));
}

void CalibrationEvidence::add(std::shared_ptr<const FittedFrame> frame) {
  if (is_closed_ || !frame) return;
  if (added_++ % step_ == 0) keep(std::move(frame));
  if (frames_.size() <= kMostFrames) return;
  const std::vector<Kept> all = std::exchange(frames_, {});
  for (std::size_t n = 0; n < all.size(); n += 2) keep(all[n].frame);
  step_ *= 2;
}

CalibrationEvidence::Others CalibrationEvidence::others_of(const FittedFrame& frame) const {
  Others others;
  for (const Kept& kept : frames_) {
    const FittedFrame& other = *kept.frame;
    if (is_same(other, frame)) continue;
    others.mended_px += other.mended_px();
    others.believed_px += std::min(other.believed_px(), other.mended_px());
    others.by_this_px += std::min(other.explained_px(frame), other.mended_px());
  }
  return others;
}

FrameVerdict CalibrationEvidence::judge(const FittedFrame& frame) const {
  const Others others = others_of(frame);
  if (others.mended_px < kLeastOfOthers_px) return {};
  if (may_serve(frame, frame.believed_px()) && others.believed_px >= kStands * others.mended_px &&
      others.believed_px >= kAsMuch * others.by_this_px)
    return {.stands = true};
  return {.better = better_for(frame, others)};
}

/// The correction that explains most of all others, if it explains half of them, far more than what
/// is believed and than the frame's own does, and enough of the frame.
std::shared_ptr<const FittedFrame> CalibrationEvidence::better_for(const FittedFrame& frame,
                                                                   const Others& others) const {
  const auto best = std::ranges::max_element(frames_, {}, &Kept::share);
  const double explained_px = best->share() * others.mended_px;
  const bool serves = best->share() >= kShared && explained_px > kFarMore * others.by_this_px &&
                      explained_px > kFarMore * others.believed_px;
  if (!serves || is_same(*best->frame, frame) ||
      !may_serve(frame, frame.explained_px(*best->frame)))
    return nullptr;
  return best->frame;
}

}  // namespace mapscore
