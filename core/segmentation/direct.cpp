// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/direct.hpp"

#include "core/segmentation/occupied_centres.hpp"

#include <utility>

namespace mapscore {

std::vector<Eigen::Vector3d> points_behind(const cv::Mat1b& mask, const PixelBox& box,
                                           const RegisteredCloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(cv::countNonZero(mask)));
  for (int v = 0; v < mask.rows; ++v)
    cloud.append_points(box.u_min, box.v_min + v, {mask[v], static_cast<std::size_t>(mask.cols)},
                        points);
  return points;
}

Segment segment_of(std::vector<Eigen::Vector3d> points, double voxel_m, bool with_voxels) {
  Segment segment;
  segment.points = std::move(points);
  if (segment.points.empty()) segment.skipped = SkipReason::no_points;
  if (with_voxels) segment.voxel_centres = occupied_centres(segment.points, voxel_m);
  return segment;
}

Segment segment_of(const cv::Mat1b& mask, const PixelBox& box, const RegisteredCloud& cloud,
                   double voxel_m, bool with_voxels) {
  return segment_of(points_behind(mask, box, cloud), voxel_m, with_voxels);
}

Segment Direct::segment(const Detection& detection, const RegisteredCloud& cloud, double voxel_m,
                        bool with_voxels) const {
  return segment_of(detection.mask, detection.box, cloud, voxel_m, with_voxels);
}

}  // namespace mapscore
