// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/segmentation/direct.hpp"
#include "core/segmentation/edge_aligned/edge_aligned.hpp"
#include "core/segmentation/erosion.hpp"
#include "core/segmentation/growing/region_growing.hpp"
#include "core/segmentation/plugged_segmentation.hpp"
#include "core/segmentation/rivals/dbscan.hpp"
#include "core/segmentation/rivals/depth_segments.hpp"
#include "core/segmentation/rivals/largest_component.hpp"
#include "core/segmentation/segment.hpp"
#include "core/segmentation/sight.hpp"

#include <memory>
#include <variant>
#include <vector>

namespace mapscore {

/// How objects are cut out of a frame (docs/methods.md). A kind is a struct of its parameters with
/// a member `segment`, of one detection and the registered cloud, or of a whole frame.
using Segmentation = std::variant<Direct, Erosion, RegionGrowing, EdgeAligned, LargestComponent,
                                  Dbscan, DepthSegments, PluggedSegmentation>;

/// A kind that takes one detection by itself.
template <class Kind>
concept ByDetection = requires(const Kind& kind, const Detection& detection,
                               const RegisteredCloud& cloud) {
  kind.segment(detection, cloud, 0.05, true);
};

/// The segments of a frame's detections, in their order. `voxel_m`: voxel edge. `with_voxels`: fill
/// `voxel_centres`. Throws Error on an edge that is not positive and parameters out of range.
/// Thread-safe.
[[nodiscard]] std::vector<Segment> segment(const Sight& sight, const Segmentation& segmentation,
                                           double voxel_m, bool with_voxels);

/// The same of frames of a map: `told` is what others tell of the believed calibration, and learns
/// from this one.
[[nodiscard]] std::vector<Segment> segment_after(CalibrationEvidence& told, const Sight& sight,
                                                 const Segmentation& segmentation, double voxel_m,
                                                 bool with_voxels);

/// Whether the segmentation mends the calibration by itself, so that frames tell each other.
[[nodiscard]] bool mends_calibration(const Segmentation& segmentation, const Calibration& believed);

/// A frame as the segmentation fits it, for CalibrationEvidence, without the rest of its work; none
/// where it does not mend the calibration, or where depth edges show nothing of the masks. Throws
/// Error on parameters out of range. Thread-safe.
[[nodiscard]] std::shared_ptr<const FittedFrame> fitted(const Sight& sight,
                                                        const Segmentation& segmentation);

/// Throws Error when one detection cannot be segmented: voxels without a positive edge, or a mask
/// that does not fit the cloud's colour image.
void check_input(const Detection& detection, const RegisteredCloud& cloud, double voxel_m);

/// What was found of a detection, with its class, instance and score, and the box of the points.
[[nodiscard]] Segment described(Segment found, const Detection& detection);

/// The same for one detection. Throws Error also when it does not fit the cloud's colour image.
template <ByDetection Kind>
[[nodiscard]] Segment segment(const Detection& detection, const RegisteredCloud& cloud,
                              double voxel_m, const Kind& kind, bool with_voxels) {
  check_ranges(kind);
  check_input(detection, cloud, voxel_m);
  return described(kind.segment(detection, cloud, voxel_m, with_voxels), detection);
}

/// The same for all detections of a frame, in their order, by a kind that takes one or all.
template <class Kind>
[[nodiscard]] std::vector<Segment> segments_of(const Kind& kind, const Sight& sight, double voxel_m,
                                               bool with_voxels) {
  if constexpr (!ByDetection<Kind>) {
    return kind.segment(sight, voxel_m, with_voxels);
  } else {
    std::vector<Segment> segments;
    segments.reserve(sight.detections().size());
    for (const Detection& detection : sight.detections())
      segments.push_back(segment(detection, sight.cloud(), voxel_m, kind, with_voxels));
    return segments;
  }
}

}  // namespace mapscore
