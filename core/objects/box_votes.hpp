// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/posed_depth.hpp"
#include "core/objects/object_box.hpp"

namespace mapscore {

/// Pixels of a depth image whose rays pass through a box between the camera's range limits, by what
/// the image measured there. The image is the z-buffer [N].
struct BoxVotes {
  int within = 0;           ///< in the box: what the box stands for is seen, or may be
  int occluded = 0;         ///< before it
  int beyond = 0;           ///< behind it: the ray saw through the box
  int unmeasured = 0;       ///< nothing
  double outline_px = 0.0;  ///< area of the box in the image plane, also beyond the image

  /// Pixels that looked at the place of the box and came back with an answer.
  [[nodiscard]] int looked() const { return within + beyond; }
  bool operator==(const BoxVotes&) const = default;
};

/// Votes of every pixel; `box` in the map frame. A measured depth z votes `occluded` when z < in -
/// tolerance, `beyond` when z > out + tolerance, else `within`; in and out: depths at which the
/// pixel's ray enters and leaves the box, cut to the camera's range. Nothing when the box is
/// outside the frustum.
[[nodiscard]] BoxVotes vote(const ObjectBox& box, const PosedDepth& view, double tolerance_m);

/// What makes an object one that should have been seen.
struct Visibility {
  double tolerance_m = 0.02;
  int min_pixels = 100;    ///< that looked at it
  double min_share = 0.5;  ///< of its outline
};

/// True when enough of its outline was looked at: not hidden, not beyond the image or the range.
[[nodiscard]] bool should_be_seen(const BoxVotes& votes, const Visibility& visibility);

}  // namespace mapscore
