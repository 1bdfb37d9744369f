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

template <ByDetection Kind>
Segment segment(const Detection& detection, const RegisteredCloud& cloud, double voxel_m,
                const Kind& kind, bool with_voxels) {
  check_edge(voxel_m);
  check_ranges(kind);
  check(detection, cloud.width_px(), cloud.height_px());
  Segment found = kind.segment(detection, cloud, voxel_m, with_voxels);
  found.class_id = detection.class_id;
  found.instance = detection.instance;
  found.score = detection.score;
  for (const Eigen::Vector3d& point : found.points) found.box.extend(point);
  return found;
}

template Segment segment(const Detection&, const RegisteredCloud&, double, const Direct&, bool);
template Segment segment(const Detection&, const RegisteredCloud&, double, const Erosion&, bool);
template Segment segment(const Detection&, const RegisteredCloud&, double, const RegionGrowing&,
                         bool);

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
