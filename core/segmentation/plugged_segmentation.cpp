// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/plugged_segmentation.hpp"

#include <algorithm>
#include <string>

namespace mapscore {
namespace {

bool all_finite(const std::vector<Eigen::Vector3d>& positions) {
  return std::ranges::all_of(positions, [](const auto& p) { return p.allFinite(); });
}

}  // namespace

std::vector<Segment> PluggedSegmentation::segment(const Sight& sight, double voxel_m,
                                                  bool with_voxels) const {
  std::vector<Segment> segments = (**this).segment(sight, voxel_m, with_voxels);
  const std::string name(kKind);
  if (segments.size() != sight.detections().size())
    throw Error(name + ": gave " + std::to_string(segments.size()) + " segments of " +
                std::to_string(sight.detections().size()) +
                " detections; give one each, Segment::nothing where it found none");
  for (const Segment& segment : segments)
    if (!all_finite(segment.points) || !all_finite(segment.voxel_centres))
      throw Error(name + ": gave a point that is not finite; leave such points out");
  return segments;
}

}  // namespace mapscore
