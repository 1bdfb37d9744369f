// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/mapping/mapper.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/geometry/posed_depth.hpp"
#include "core/placement/placement.hpp"

#include <ctime>
#include <utility>
#include <variant>

namespace mapscore {
namespace {

/// Processor time of this thread since its start.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Points of the depth image, in frame map.
std::vector<Eigen::Vector3d> points_of(const PosedDepth& seen) {
  const DepthRays rays(seen.camera);
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < seen.depth.rows; ++v)
    for (int u = 0; u < seen.depth.cols; ++u)
      if (const double z = seen.depth(v, u) / kDepthUnitsPerMetre;
          z > 0.0 && z >= seen.range_min_m && z <= seen.range_max_m)
        points.push_back(seen.T_map_camera * rays.point(u, v, z));
  return points;
}

}  // namespace

Mapper::Mapper(const Mapping& mapping, std::size_t class_count, CalibrationEvidence told)
    : mapping_(mapping),
      class_count_(class_count),
      map_(mapping.voxel_m, mapping.occupancy),
      choice_(mapping.frames),
      told_(std::move(told)) {
  check(mapping.fusion.rule);
}

bool Mapper::takes(const Sight& sight, const PoseBelief& belief) {
  return choice_.takes(sight.depth(), sight.believed(), belief.T_map_odom * belief.T_odom_base);
}

std::vector<Segment> Mapper::integrate(const Sight& sight, const PoseBelief& belief,
                                       RandomStream& stream) {
  const double start_s = thread_seconds();
  const bool by_voxels = mapping_.place == Place::voxels;
  std::vector<Segment> segments =
      segment_after(told_, sight, mapping_.segmentation, mapping_.voxel_m, by_voxels);
  times_.segmentation_s = thread_seconds() - start_s;
  const auto placed = [by_voxels](Segment& segment) -> std::vector<Eigen::Vector3d>& {
    return by_voxels ? segment.voxel_centres : segment.points;
  };
  Observation observation;  // borrows what it places
  for (Segment& segment : segments)
    observation.push_back({segment.class_id, segment.score, std::move(placed(segment))});
  fuse(observation, sight, belief, stream);
  for (std::size_t n = 0; n < segments.size(); ++n)
    placed(segments[n]) = std::move(observation[n].positions);
  return segments;
}

void Mapper::fuse(const Observation& observation, const Sight& seen, const PoseBelief& belief,
                  RandomStream& stream) {
  const double start_s = thread_seconds();
  const Calibration& believed = seen.believed();
  std::vector<Pose> T_map_depth = draw_poses(belief, mapping_.fusion.draws, stream);
  for (Pose& pose : T_map_depth) pose = pose * believed.T_base_depth;
  const std::vector<VoxelHit> hits = place(observation, T_map_depth, mapping_.voxel_m);
  const PosedDepth view{believed.depth, mean_sensor_pose(belief, believed), believed.range_min_m,
                        believed.range_max_m, seen.depth()};
  if (map_.carves()) map_.see(view.T_map_camera.translation(), points_of(view), hits);
  if (const auto* blend = std::get_if<BlendRule>(&mapping_.fusion.rule);
      blend && blend->decay == Decay::view)
    map_.decay_in_view(DepthView(view), *blend, hits);
  map_.fuse(hits, mapping_.fusion.draws.N, mapping_.fusion.rule, class_count_);
  times_.mapping_s = thread_seconds() - start_s;
}

void Mapper::add_colours(const Sight& sight, const cv::Mat3b& bgr, const PoseBelief& belief) {
  const RegisteredCloud& cloud = sight.cloud();
  const Pose T_map_depth = mean_sensor_pose(belief, sight.believed());
  std::vector<ColouredPoint> colours;
  for (int v = 0; v < bgr.rows; ++v) {
    for (int u = 0; u < bgr.cols; ++u) {
      const int source = cloud.source(u, v);
      if (source == RegisteredCloud::kNone) continue;
      const cv::Vec3b pixel = bgr(v, u);
      colours.push_back({T_map_depth * cloud.point(source), {pixel[2], pixel[1], pixel[0]}});
    }
  }
  map_.add_colours(colours);
}

Pose mean_sensor_pose(const PoseBelief& belief, const Calibration& believed) {
  return belief.T_map_odom * belief.T_odom_base * believed.T_base_depth;
}

}  // namespace mapscore
