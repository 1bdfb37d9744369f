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
constexpr double kServes = 0.5;            // of that, what a correction explains that serves all,
constexpr double kFarMore = 1.5;           // before it is refined, over what is explained without,
constexpr double kMore = 1.2;              // and over what the frame's own correction explains
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

/// What a correction explains of another frame: no more than that one's own does.
double part_px(const FittedFrame& of, const FittedFrame& correction) {
  return std::min(of.explained_px(correction), of.mended_px());
}

/// The same of all frames but its own, as a share of what their own corrections explain.
double share_of_others(const std::vector<std::shared_ptr<const FittedFrame>>& all,
                       const FittedFrame& correction) {
  double others_px = 0, explained_px = 0;
  for (const auto& frame : all) {
    if (is_same(*frame, correction)) continue;
    others_px += frame->mended_px();
    explained_px += part_px(*frame, correction);
  }
  return others_px > 0 ? explained_px / others_px : 0;
}

}  // namespace

void CalibrationEvidence::add(std::shared_ptr<const FittedFrame> frame) {
  if (is_closed_ || !frame || added_++ % step_ != 0) return;
  frames_.push_back({std::move(frame)});
  if (frames_.size() > kMostFrames) {
    for (std::size_t n = 0; 2 * n < frames_.size(); ++n) frames_[n] = frames_[2 * n];
    frames_.resize((frames_.size() + 1) / 2);
    step_ *= 2;
  }
  agree();
}

/// Takes the correction that explains most of all frames, refined on all.
void CalibrationEvidence::agree() {
  std::vector<std::shared_ptr<const FittedFrame>> all;
  for (const Kept& kept : frames_) all.push_back(kept.frame);
  agreed_ = nullptr;
  served_ = 0;
  for (const auto& frame : all)
    if (const double share = share_of_others(all, *frame); share > served_)
      served_ = share, agreed_ = frame;
  const auto refined = agreed_ ? agreed_->refined_on(all) : nullptr;
  if (refined && share_of_others(all, *refined) > served_) agreed_ = refined;
  for (Kept& kept : frames_) kept.by_agreed_px = agreed_ ? part_px(*kept.frame, *agreed_) : 0;
}

FrameVerdict CalibrationEvidence::judge(const FittedFrame& frame) const {
  double mended_px = 0, believed_px = 0, agreed_px = 0, by_this_px = 0;
  const auto for_others = [&](auto&& use) {
    for (const Kept& kept : frames_)
      if (!is_same(*kept.frame, frame)) use(kept);
  };
  for_others([&](const Kept& other) {
    mended_px += other.frame->mended_px();
    believed_px += std::min(other.frame->believed_px(), other.frame->mended_px());
    agreed_px += other.by_agreed_px;
  });
  if (mended_px < kLeastOfOthers_px) return {};
  const bool may_stand =
      believed_px >= kStands * mended_px && may_serve(frame, frame.believed_px());
  const bool may_agree = agreed_px >= kServes * mended_px &&
                         served_ * mended_px > kFarMore * believed_px &&
                         may_serve(frame, frame.explained_px(*agreed_));
  if (!may_stand && !may_agree) return {};
  for_others([&](const Kept& other) { by_this_px += part_px(*other.frame, frame); });
  if (may_stand && believed_px >= kAsMuch * by_this_px) return {.stands = true};
  if (may_agree && agreed_px > kMore * by_this_px) return {.agreed = agreed_};
  return {};
}

}  // namespace mapscore
