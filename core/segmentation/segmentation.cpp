// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/segmentation/segmentation.hpp"

#include "core/error.hpp"
#include "core/segmentation/erosion.hpp"
#include "core/segmentation/occupied_centres.hpp"
#include "core/segmentation/region_growing.hpp"

#include <cmath>

namespace mapscore {
namespace {

/// Points of the mask's pixels that have one, in row-major order of the pixels.
std::vector<Eigen::Vector3d> points_of(const cv::Mat1b& mask, const PixelBox& box,
                                       const RegisteredCloud& cloud) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(static_cast<std::size_t>(cv::countNonZero(mask)));
  for (int v = 0; v < mask.rows; ++v) {
    const std::uint8_t* inside = mask[v];
    const int* sources = cloud.sources()[v + box.v_min] + box.u_min;
    for (int u = 0; u < mask.cols; ++u)
      if (inside[u] && sources[u] != RegisteredCloud::kNone)
        points.push_back(cloud.point(sources[u]));
  }
  return points;
}

/// Fills a segment by one method; `skipped` says why it stayed empty.
struct Segmenter {
  const Detection& detection;
  const RegisteredCloud& cloud;
  double voxel_m;
  bool with_voxels;
  Segment& segment;

  void operator()(const DirectParams&) const { keep(detection.mask); }

  void operator()(const ErosionParams& params) const {
    const cv::Mat1b eroded =
        erode_mask(detection, params.radius_px, cloud.width_px(), cloud.height_px());
    if (cv::countNonZero(eroded) == 0)
      segment.skipped = SkipReason::eroded_away;
    else
      keep(eroded);
  }

  void operator()(const RegionGrowingParams& params) const {
    const std::vector<Eigen::Vector3d> points = points_of(detection.mask, detection.box, cloud);
    const auto seed = seed_point(detection, cloud, params.seed);
    if (points.empty() || !seed) {
      segment.skipped = points.empty() ? SkipReason::no_points : SkipReason::no_seed_point;
      return;
    }
    const auto grow = params.kd_tree ? grow_region_reference : grow_region;
    const Region region = grow(points, *seed, voxel_m, params.radius_factor, params.released);
    if (region.points.empty()) segment.skipped = SkipReason::seed_off_object;
    segment.points.reserve(region.points.size());
    for (const int index : region.points)
      segment.points.push_back(points[static_cast<std::size_t>(index)]);
    if (!with_voxels) return;
    for (const VoxelKey& key : region.positions)
      segment.voxel_centres.push_back(lattice_position(*seed, voxel_m, key));
  }

  void operator()(const EdgeAlignedParams&) const {
    throw Error("edge_aligned: segments a whole frame; call segment_frame");
  }

  void keep(const cv::Mat1b& mask) const {
    segment.points = points_of(mask, detection.box, cloud);
    if (segment.points.empty()) segment.skipped = SkipReason::no_points;
    if (with_voxels) segment.voxel_centres = occupied_centres(segment.points, voxel_m);
  }
};

}  // namespace

Segment segment(const Detection& detection, const RegisteredCloud& cloud, double voxel_m,
                const SegmentationParams& params, bool with_voxels) {
  if (!(voxel_m > 0.0) || !std::isfinite(voxel_m))
    throw Error("voxel_m: must be a positive length in metres");
  check(detection, cloud.width_px(), cloud.height_px());
  Segment segment;
  segment.class_id = detection.class_id;
  segment.instance = detection.instance;
  segment.score = detection.score;
  std::visit(Segmenter{detection, cloud, voxel_m, with_voxels, segment}, params);
  for (const Eigen::Vector3d& point : segment.points) segment.box.extend(point);
  return segment;
}

}  // namespace mapscore
