// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/calibration_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore {
namespace {

// A fit without a correction is no chance where it is so sharp and leaves the masks' size as it is.
constexpr double kSharpFit = 0.6, kSameSize_px = 1.0;
constexpr double kStands = 0.4;            // of what corrections explain, in both directions
constexpr double kFarCorrection_px = 3.0;  // beyond, a correction needs what lies elsewhere
constexpr double kToThePixel = 0.8;        // sharpness of what leaves nothing to correct,
constexpr double kEnoughSeen_px = 300.0;   // if so much outline was explained before
constexpr double kLeastOfMended = 0.15;    // of what a frame's own correction explains,
constexpr double kMostGain_px = 500;       // and outline that it explains beyond: then it moved

double sum(const FrameFits::Explained& explained_px) {
  return explained_px[0] + explained_px[1];
}

}  // namespace

void CalibrationEvidence::add(const FrameFits& frame) {
  const bool stands = frame.sharpness > kSharpFit && std::abs(frame.offset_px) < kSameSize_px;
  for (std::size_t n = 0; n < 2; ++n) {
    mended_px_[n] += frame.mended_px[n];
    if (stands) standing_px_[n] += std::min(frame.believed_px[n], frame.mended_px[n]);
  }
  believed_px_ += sum(frame.believed_px);
  sharp_px_ += frame.sharpness * sum(frame.believed_px);
}

bool CalibrationEvidence::stands_in(const FrameFits& frame) const {
  CalibrationEvidence all = *this;
  all.add(frame);
  for (std::size_t n = 0; n < 2; ++n)
    if (all.standing_px_[n] < kStands * all.mended_px_[n]) return false;
  const bool to_the_pixel =
      sum(mended_px_) > kEnoughSeen_px && all.sharp_px_ > kToThePixel * all.believed_px_;
  const double mended_px = sum(frame.mended_px), believed_px = sum(frame.believed_px);
  return (to_the_pixel || frame.apart_px > kFarCorrection_px) &&
         believed_px > kLeastOfMended * mended_px && mended_px - believed_px < kMostGain_px;
}

}  // namespace mapscore
