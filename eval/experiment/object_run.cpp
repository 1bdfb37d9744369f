// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/object_run.hpp"

#include "core/error.hpp"
#include "core/objects/solid_piece.hpp"
#include "core/segmentation/frame_segmentation.hpp"
#include "eval/experiment/doses.hpp"
#include "eval/experiment/sensor_doses.hpp"
#include "eval/experiment/trial_run.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <numbers>

namespace mapscore::eval {
namespace {

std::vector<int> paired_depth(const Recording& recording, const Study& config) {
  std::vector<int> depth;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    depth.push_back(recording.depth_of(frame, config.faults.time_offset_ms / 1000.0));
  return depth;
}

Eigen::AlignedBox3d bounds_of(const std::vector<Eigen::Vector3d>& points,
                              const Pose& T_map_points) {
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& p : points) bounds.extend(T_map_points * p);
  return bounds;
}

}  // namespace

ObjectRun::ObjectRun(const Task& task, const Recording& recording, const ClassTable& table,
                     PoseSources& poses, const ObjectRunOptions& options)
    : task_(task),
      recording_(recording),
      table_(table),
      believed_(believed_calibration(recording.info().calibration, task)),
      depth_of_(paired_depth(recording, task.config)),
      beliefs_(poses.beliefs(task, depth_of_)),
      depth_dose_(dose_of(task.config.faults.depth)),
      label_dose_(dose_of(task.config.faults.labels)),
      segmentation_(segmentation_params(task.config.methods.front().segmentation)),
      map_frame_(map_frame(task.config, task.seed_index)),
      options_(options),
      simulated_(simulated_labels(task.config, recording, table)),
      map_(table.classes.size(), options.map),
      seen_(table.instances.size()) {}

void ObjectRun::start_from(const ObjectFile& known) {
  const Pose T_map_known = map_frame_.T_map_world() * known.T_world_map();
  for (MapObject object : known.objects) {
    object.box = moved(T_map_known, object.box);
    map_.add(std::move(object));
  }
}

std::vector<ObjectDetection> ObjectRun::detect(const Frame& frame, const cv::Mat1w& depth,
                                               const Pose& T_map_depth) const {
  const cv::Mat1w label = simulated_ ? simulated_->of(frame) : frame.label;
  const std::vector<Detection> detections =
      sim::corrupt_detections(label, simulated_ ? simulated_->table() : table_, label_dose_,
                              trial_seed(task_), frame.index);
  const std::vector<Segment> segments =
      segment_frame(detections, depth, believed_, map_frame_.edge_m, segmentation_, false);
  std::vector<ObjectDetection> found;
  for (const Segment& segment : segments) {
    const std::vector<Eigen::Vector3d> solid =
        largest_solid_piece(segment.points, options_.piece_m);
    if (solid.size() < static_cast<std::size_t>(options_.min_points)) continue;
    found.push_back({segment.class_id, oriented(bounds_of(solid, T_map_depth)), segment.score, {}});
  }
  return found;
}

ObjectChanges ObjectRun::advance(const Frame& frame) {
  const Calibration& truth = recording_.info().calibration;
  const PoseBelief& belief = beliefs_.at(static_cast<std::size_t>(frame.index));
  const Pose T_map_depth = belief.T_map_odom * belief.T_odom_base * believed_.T_base_depth;
  const PosedDepth view{believed_.depth, T_map_depth, believed_.range_min_m, believed_.range_max_m,
                        sim::corrupt_depth(frame.depth, truth.depth, depth_dose_, trial_seed(task_),
                                           frame.depth_index)};
  if (!frame.depth_label.empty())
    seen_.add(frame, truth, map_frame_.T_map_world() * frame.T_world_base);
  return map_.integrate(detect(frame, view.depth, T_map_depth), frame.stamp_s, &view);
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
