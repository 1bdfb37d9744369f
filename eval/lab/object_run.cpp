// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/object_run.hpp"

#include "core/error.hpp"
#include "core/mapping/mapper.hpp"
#include "core/objects/solid_piece.hpp"
#include "eval/lab/recorded_surfaces.hpp"

#include <numbers>

namespace mapscore::eval {

ObjectRun::ObjectRun(const Task& task, const Recording& recording, const ClassTable& table,
                     PoseSources& poses, const ObjectRunOptions& options)
    : recording_(recording),
      table_(table),
      sights_(task, recording, table),
      beliefs_(poses.beliefs(task, sights_.depth_of_frames())),
      segmentation_(task.config.methods.front().segmentation),
      choice_(task.config.methods.front().frames),
      told_(sights_.told(recording, segmentation_, task.config.methods.front().frames)),
      map_frame_(map_frame(task.config, task.seed_index)),
      options_(options),
      map_(table.classes.size(), options.map),
      seen_(table.instances.size()) {}

void ObjectRun::start_from(const ObjectFile& known) {
  const Pose T_map_known = map_frame_.T_map_world() * known.T_world_map();
  for (MapObject object : known.objects) {
    object.box = moved(T_map_known, object.box);
    map_.add(std::move(object));
  }
}

std::vector<ObjectDetection> object_detections(const std::vector<Segment>& segments,
                                               const Pose& T_map_depth,
                                               const ObjectRunOptions& options) {
  std::vector<ObjectDetection> found;
  for (const Segment& segment : segments) {
    const std::vector<Eigen::Vector3d> solid = largest_solid_piece(segment.points, options.piece_m);
    if (solid.size() < static_cast<std::size_t>(options.min_points)) continue;
    Eigen::AlignedBox3d bounds;
    for (const Eigen::Vector3d& p : solid) bounds.extend(T_map_depth * p);
    found.push_back({segment.class_id, oriented(bounds), segment.score, {}});
  }
  return found;
}

ObjectChanges ObjectRun::advance(const Frame& frame) {
  const Calibration& truth = recording_.info().calibration;
  const Sight sight = sights_.of(frame);
  const Calibration& believed = sight.believed();
  const PoseBelief& belief = beliefs_.at(static_cast<std::size_t>(frame.index));
  const Pose T_map_depth = mean_sensor_pose(belief, believed);
  const PosedDepth view{believed.depth, T_map_depth, believed.range_min_m, believed.range_max_m,
                        sight.depth()};
  if (!frame.depth_label.empty())
    seen_.add(frame, truth, map_frame_.T_map_world() * frame.T_world_base);
  if (!choice_.takes(sight.depth(), believed, belief.T_map_odom * belief.T_odom_base)) return {};
  const std::vector<Segment> segments =
      segment_after(told_, sight, segmentation_, map_frame_.edge_m, false);
  return map_.integrate(object_detections(segments, T_map_depth, options_), frame.stamp_s, &view);
}

ObjectFile ObjectRun::file() const {
  return {map_frame_.origin_m, map_frame_.yaw_rad * 180.0 / std::numbers::pi, map_.objects()};
}

std::vector<TrueObject> ObjectRun::truth(bool seen) const {
  if (!recording_.info().has_truth)
    throw Error(recording_.folder().string() + ": has no truth; its objects cannot be scored");
  if (seen) return visible_objects(seen_.boxes(), seen_, table_);
  const std::vector<Shape> shapes =
      shapes_of(recording_).at(recording_.depth_stamp_s(recording_.depth_count() - 1));
  return visible_objects(surface_boxes(shapes, map_frame_.T_map_world(), table_.instances.size()),
                         seen_, table_);
}

}  // namespace mapscore::eval
