// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/frame_segmentation.hpp"

#include "core/segmentation/edge_aligned.hpp"
#include "core/segmentation/registered_cloud.hpp"

namespace mapscore {

std::vector<Segment> segment_frame(const std::vector<Detection>& detections, const cv::Mat1w& depth,
                                   const Calibration& believed, double voxel_m,
                                   const SegmentationParams& params, bool with_voxels) {
  check(believed);
  for (const Detection& detection : detections)
    check(detection, believed.color.width_px, believed.color.height_px);
  if (const auto* aligned = std::get_if<EdgeAlignedParams>(&params))
    return segment_edge_aligned(detections, depth, believed, voxel_m, *aligned, with_voxels);
  const RegisteredCloud cloud =
      register_depth(depth, believed,
                     pixels_wanted(detections, believed.color.width_px, believed.color.height_px));
  std::vector<Segment> segments;
  segments.reserve(detections.size());
  for (const Detection& detection : detections)
    segments.push_back(segment(detection, cloud, voxel_m, params, with_voxels));
  return segments;
}

}  // namespace mapscore
