// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>

namespace mapscore {

/// How well a frame's masks fit its depth edges with the correction of the calibration that
/// explains most, and without one.
struct FrameFits {
  /// Length of the masks' outlines on which edges lie: of those that face left or right, and of
  /// those that face up or down, since a shift along the ones leaves them where they are.
  using Explained = std::array<double, 2>;
  Explained mended_px = {};    ///< with the correction
  Explained believed_px = {};  ///< without one, with the masks' size fitted alone
  double sharpness = 1;  ///< without one: what edges near the outlines explain over what those
                         ///< farther away do too (OutlineAlignment::sharpness); 0 of no fit
  double offset_px = 0;  ///< without one: by which the masks seem too small
  double apart_px = 0;   ///< how far the correction moves edges, root mean square
};

/// What the frames of a map tell, one after the other, of the calibration that is believed
/// (docs/segmentation.md, "Frames before it"). A wrong one fits by chance in single frames, and so
/// does a wrong correction, but not in all. Safe to read from several threads.
class CalibrationEvidence {
 public:
  /// Takes a frame into account.
  void add(const FrameFits& frame);

  /// Whether a frame's calibration is as believed, by what was added and by the frame itself,
  /// though a correction explains more of its outlines.
  [[nodiscard]] bool stands_in(const FrameFits& frame) const;

 private:
  FrameFits::Explained mended_px_ = {};    ///< by each frame's correction
  FrameFits::Explained standing_px_ = {};  ///< without one, where it fits sharply
  double believed_px_ = 0;                 ///< without one, in all frames
  double sharp_px_ = 0;                    ///< these, times the fit's sharpness
};

}  // namespace mapscore
