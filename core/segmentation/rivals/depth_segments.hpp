// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/sight.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore {

/// How segments of the depth image are given to masks.
enum class SegmentRule {
  covers,  ///< a segment is, whole, the mask's that covers most of it
  votes    ///< a segment keeps its pixels of each mask that it lies in
};
constexpr auto names_of(SegmentRule) {
  return std::to_array<std::string_view>({"covers", "votes"});
}

/// Segments of the depth image, found by depth discontinuity and convexity alone, are given to the
/// masks that cover them: Furrer et al. (IROS 2018), Voxblox++ (Grinvald et al., RA-L 2019).
/// Segments a whole frame at once.
struct DepthSegments {
  static constexpr std::string_view kKind = "depth_segments";
  static constexpr std::string_view kMeaning =
      "segments of the depth image, given to the masks that cover them (Voxblox++)";
  SegmentRule rule = SegmentRule::covers;
  std::optional<double> share{};  ///< empty: as the rule has it
  double discontinuity = 0.01, convexity = 0.97;
  int normal_window_px = 5, min_segment_px = 500;

  static void fields(auto& s, auto&& visit) {
    visit(s.rule, Field{"rule", "covers: whole segments; votes: their pixels of the mask"});
    visit(s.share, Field{"share",
                         "a mask must hold more than this share of a segment; without it 0.8 for "
                         "covers, 0.5 for votes",
                         {0, 1}});
    visit(s.discontinuity,
          Field{"discontinuity",
                "a larger step between neighbouring pixels, over depth, is an edge", above(0, 10)});
    visit(s.convexity,
          Field{"convexity",
                "surfaces whose normals have at most this cosine meet in an edge where "
                "they are concave",
                {-1, 1}});
    visit(s.normal_window_px,
          Field{"normal_window_px", "side of the window of a normal, an odd number", {3, 101}});
    visit(s.min_segment_px, Field{"min_segment_px", "smaller segments are dropped", {1, 1000000}});
  }
  /// Segments of all detections, in their order; points in row-major order of their depth pixels.
  /// Throws Error on parameters out of range.
  [[nodiscard]] std::vector<Segment> segment(const Sight& sight, double voxel_m,
                                             bool with_voxels) const;
  /// `share`, or what the rule has in its place.
  [[nodiscard]] double least_share() const {
    return share.value_or(rule == SegmentRule::covers ? 0.8 : 0.5);
  }
  bool operator==(const DepthSegments&) const = default;
};

}  // namespace mapscore
