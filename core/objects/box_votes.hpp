// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/posed_depth.hpp"
#include "core/objects/object_box.hpp"

namespace mapscore {

/// Pixels of a depth image whose rays meet a box within the camera's range, counted by where the
/// measured depth lies relative to the box. The depth image serves as z-buffer [N].
struct BoxVotes {
  int within = 0;           ///< in the box: the object may still be there
  int occluded = 0;         ///< in front of the box: something hides it
  int beyond = 0;           ///< behind the box: the ray passed through it
  int unmeasured = 0;       ///< pixels without depth
  double outline_px = 0.0;  ///< area of the box in the image plane, also beyond the image

  /// Pixels that measured the box's place: neither hidden nor without depth.
  [[nodiscard]] int looked() const { return within + beyond; }
  bool operator==(const BoxVotes&) const = default;
};

/// Votes of every pixel; `box` in the map frame. A measured depth z votes `occluded` when z < in -
/// tolerance, `beyond` when z > out + tolerance, else `within`; in and out: depths at which the
/// pixel's ray enters and leaves the box, cut to the camera's range. Nothing when the box is
/// outside the frustum.
[[nodiscard]] BoxVotes vote(const ObjectBox& box, const PosedDepth& view, double tolerance_m);

/// When a camera should have detected an object.
struct Visibility {
  double tolerance_m = 0.02;  ///< of vote()
  int min_pixels = 100;       ///< least BoxVotes::looked()
  double min_share = 0.5;     ///< least BoxVotes::looked() over outline_px
};

/// True when enough of the box was in view: not hidden, not outside the image or the range.
[[nodiscard]] bool should_be_seen(const BoxVotes& votes, const Visibility& visibility);

}  // namespace mapscore
