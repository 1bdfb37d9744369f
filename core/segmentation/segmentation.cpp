// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/segmentation.hpp"

#include "core/error.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace mapscore {
namespace {

void check_edge(double voxel_m) {
  if (!(voxel_m > 0.0) || !std::isfinite(voxel_m))
    throw Error("voxel_m: must be a positive length in metres");
}

/// Bounds of points. Four at a time, so that the compiler makes vectors and no minimum waits for
/// the one before.
Eigen::AlignedBox3d box_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  if (points.empty()) return box;
  constexpr std::size_t kLanes = 12;
  std::array<double, kLanes> low{}, high{};
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    low[lane] = high[lane] = points.front()[static_cast<Eigen::Index>(lane % 3)];
  const double* values = points.front().data();
  const std::size_t whole = 3 * points.size() / kLanes * kLanes;
  for (std::size_t n = 0; n < whole; n += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double value = values[n + lane];
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
    }
  for (std::size_t lane = 0; lane < kLanes; lane += 3) {
    box.extend(Eigen::Vector3d(low[lane], low[lane + 1], low[lane + 2]));
    box.extend(Eigen::Vector3d(high[lane], high[lane + 1], high[lane + 2]));
  }
  for (std::size_t n = whole / 3; n < points.size(); ++n) box.extend(points[n]);
  return box;
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
  found.box.extend(box_of(found.points));
  return found;
}

std::vector<Segment> segment(const Sight& sight, const Segmentation& segmentation, double voxel_m,
                             bool with_voxels) {
  check_edge(voxel_m);
  return std::visit(
      [&](const auto& kind) { return segments_of(kind, sight, voxel_m, with_voxels); },
      segmentation);
}

std::vector<Segment> segment_after(CalibrationEvidence& told, const Sight& sight,
                                   const Segmentation& segmentation, double voxel_m,
                                   bool with_voxels) {
  std::vector<Segment> segments = segment(sight.among(told), segmentation, voxel_m, with_voxels);
  if (!segments.empty()) told.add(segments.front().fit);
  return segments;
}

bool mends_calibration(const Segmentation& segmentation, const Calibration& believed) {
  const auto* aligned = std::get_if<EdgeAligned>(&segmentation);
  return aligned != nullptr && mends_calibration(*aligned, believed);
}

std::shared_ptr<const FittedFrame> fitted(const Sight& sight, const Segmentation& segmentation) {
  const auto* aligned = std::get_if<EdgeAligned>(&segmentation);
  return aligned != nullptr ? fitted(sight, *aligned) : nullptr;
}

}  // namespace mapscore
