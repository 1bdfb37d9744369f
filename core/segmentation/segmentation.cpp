// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/segmentation.hpp"

#include "core/error.hpp"

#include <cmath>

namespace mapscore {
namespace {

void check_edge(double voxel_m) {
  if (!(voxel_m > 0.0) || !std::isfinite(voxel_m))
    throw Error("voxel_m: must be a positive length in metres");
}

}  // namespace

void check_input(const Detection& detection, const RegisteredCloud& cloud, double voxel_m) {
  check_edge(voxel_m);
  check(detection, cloud.width_px(), cloud.height_px());
}

Segment described(Segment found, const Detection& detection) {
  found.class_id = detection.class_id;
  found.instance = detection.instance;
  found.score = detection.score;
  for (const Eigen::Vector3d& point : found.points) found.box.extend(point);
  return found;
}

std::vector<Segment> segment(const Sight& sight, const Segmentation& segmentation, double voxel_m,
                             bool with_voxels) {
  check_edge(voxel_m);
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> std::vector<Segment> {
        if constexpr (!ByDetection<Kind>) {
          return kind.segment(sight, voxel_m, with_voxels);
        } else {
          std::vector<Segment> segments;
          segments.reserve(sight.detections().size());
          for (const Detection& detection : sight.detections())
            segments.push_back(segment(detection, sight.cloud(), voxel_m, kind, with_voxels));
          return segments;
        }
      },
      segmentation);
}

}  // namespace mapscore
