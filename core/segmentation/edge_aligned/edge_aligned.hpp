// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"
#include "core/parameters.hpp"
#include "core/segmentation/detection.hpp"
#include "core/segmentation/edge_aligned/outline_alignment.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/sight.hpp"

#include <opencv2/core.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace mapscore {

/// What each frame's fit may change: registration and size of the masks, or their size alone, which
/// is cheaper and right where the calibration is known. One that is doubtful (Calibration) is not:
/// then both are fitted.
enum class OutlineFit { calibration, masks };
constexpr auto names_of(OutlineFit) {
  return std::to_array<std::string_view>({"calibration", "masks"});
}

/// Outlines of a frame's masks fitted to its depth edges, then votes on the depth surface
/// (docs/methods.md). Segments a whole frame at once.
struct EdgeAligned {
  static constexpr std::string_view kKind = "edge_aligned";
  static constexpr std::string_view kMeaning =
      "fit a frame's masks to its depth edges, then vote on the depth surface";
  double search_px = 40, reach_px = 3;
  OutlineFit fit = OutlineFit::calibration;

  static void fields(auto& s, auto&& visit) {
    visit(s.search_px, Field{"search_px",
                             "largest turn that the search tries; the fit after it may go farther",
                             {0, 200}});
    visit(s.reach_px,
          Field{"reach_px",
                "how far votes spread over a depth surface; two thirds of it where the masks' "
                "outlines are sharp",
                above(0, 100)});
    visit(s.fit, later({"fit",
                        "what each frame mends: its calibration and the masks' size, or, of a "
                        "calibration that is known (not one whose estimate was refused), the "
                        "masks' size alone"}));
  }
  /// Segments of all detections, in their order; points in row-major order of their depth pixels.
  [[nodiscard]] std::vector<Segment> segment(const Sight& sight, double voxel_m,
                                             bool with_voxels) const;
  bool operator==(const EdgeAligned&) const = default;
};

/// Depth pixels with the detections they belong to.
struct LabelledDepth {
  cv::Mat1w labels;                  ///< 1 + index of the detection; 0 for none
  cv::Mat1f inverse_depth;           ///< of the surface at labelled pixels, 1/m; empty: as measured
  OutlineAlignment alignment;        ///< what was mended
  std::optional<double> confidence;  ///< confidence_of; none of a calibration that is known
  std::shared_ptr<const FittedFrame> fit;  ///< as `fitted` gives it, for other frames
  bool is_known = false;  ///< the calibration: taken as believed, or as other frames have it
};

/// Whether frames are fitted with corrections of the calibration: it is not known.
[[nodiscard]] inline bool mends_calibration(const EdgeAligned& params,
                                            const Calibration& believed) {
  return params.fit == OutlineFit::calibration || believed.is_doubtful;
}

/// The frame's fits alone; none of a calibration that is known, or of a frame whose edges show
/// nothing of its masks. Throws Error on parameters out of range.
[[nodiscard]] std::shared_ptr<const FittedFrame> fitted(const Sight& sight,
                                                        const EdgeAligned& params);

/// Labels a frame's depth pixels; of a noisy depth image settles them on their surfaces too
/// (settled_depth.hpp). Throws Error on parameters out of range.
[[nodiscard]] LabelledDepth label_surfaces(const Sight& sight, const EdgeAligned& params);

}  // namespace mapscore
