// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/detection.hpp"
#include "core/segmentation/edge_aligned/depth_edges.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <vector>

namespace mapscore {

/// The masks of a frame as one field over the colour image. An outline runs half-way between a
/// mask's pixels and the others; the image's own edge is none. A groove is a gap of up to
/// kGroove_px in a row or column between two masks, as of objects that touch where masks are too
/// small. In its middle the distance to the nearest outline has a ridge, so an edge that lies there
/// would say nothing: to fit outlines, grooves are closed, half by each mask.
struct OutlineField {
  /// 1 + index of the detection whose mask holds the pixel, 0 for none; grooves closed.
  cv::Mat1w owner;
  /// Pixels to the nearest outline of `owner`, negative inside a mask, in whose lowest bits is its
  /// Border (outline_distance.hpp); +-kFar far from all masks.
  cv::Mat1f distance;
  std::vector<cv::Point> closed;  ///< pixels of grooves, which no mask holds by itself
  /// How well an edge that faces Outward d fits at quarter size, 0 to 255: 255 on outlines that
  /// face the same way, less within 8 pixels and for those that face the other way.
  std::array<cv::Mat1b, 4> coarse;
  /// Number of outline elements that face each way, by cell; rows of one image, way by way. An
  /// element is a pair of neighbouring pixels on either side of an outline, counted for each owner.
  std::array<cv::Mat1f, 4> elements;
  int length_px = 0;  ///< number of all outline elements

  static constexpr float kFar = 1e4F;
  static constexpr int kGroove_px = 5;
  /// Weight of what faces against the outline it lies on: something stands in front there.
  static constexpr double kOtherWay = 0.7;
  static constexpr int kCell_px = 4;  ///< edge of a cell of `coarse` and `elements`
};

/// Grows all masks together by up to `reach_px` steps along rows and columns: each background pixel
/// gets the owner reached in the fewest steps, ties to the lower index.
[[nodiscard]] cv::Mat1w spread_owners(const cv::Mat1w& masks, int reach_px);

/// `reach_px`, at least 1: how far from the masks the field is wanted.
[[nodiscard]] OutlineField outline_field(const std::vector<Detection>& detections, int width_px,
                                         int height_px, int reach_px);

/// The masks of a frame as they are.
struct MaskField {
  cv::Mat1w owner;     ///< 1 + index of the detection whose mask holds the pixel, 0 for none
  cv::Mat1f distance;  ///< as an OutlineField's up to 15.5 px; farther away it is more than that
};

/// Opens the grooves of a field again: owners in its own image, distances in a copy where any was
/// closed, since a fit may keep them.
[[nodiscard]] MaskField open_grooves(OutlineField&& field);

}  // namespace mapscore
