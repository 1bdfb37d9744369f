// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/trial_run.hpp"

#include "core/mapping/placement.hpp"
#include "core/mapping/pose_belief.hpp"
#include "core/refinement/map_refinement.hpp"
#include "core/segmentation/frame_segmentation.hpp"
#include "eval/experiment/doses.hpp"
#include "eval/experiment/frame_fusion.hpp"
#include "eval/experiment/map_frame.hpp"
#include "eval/experiment/sensor_doses.hpp"
#include "eval/experiment/trial_seed.hpp"
#include "eval/score/instance_score.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <limits>
#include <utility>

namespace mapscore::eval {
namespace {

double time_offset_s(const Study& config) {
  return config.faults.time_offset_ms / 1000.0;
}

/// The depth image of every frame under the time offset.
std::vector<int> paired_depth(const Recording& recording, const Study& config) {
  std::vector<int> depth;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    depth.push_back(recording.depth_of(frame, time_offset_s(config)));
  return depth;
}

ObservedObject& object_of(ClassId class_id, Observation& observation) {
  for (ObservedObject& object : observation)
    if (object.class_id == class_id) return object;
  return observation.emplace_back(ObservedObject{class_id, 1.0, {}});
}

std::vector<int> positive(const std::vector<int>& tolerances) {
  std::vector<int> kept;
  for (const int tolerance : tolerances)
    if (tolerance > 0) kept.push_back(tolerance);
  return kept;
}

}  // namespace

Calibration believed_calibration(const Calibration& truth, const Task& task) {
  const std::uint64_t seed = trial_seed(task);
  const Calibration misregistered =
      sim::misregister(truth, dose_of(task.config.faults.misregistration), seed);
  return sim::misplace_mount(misregistered, dose_of(task.config.faults.mount), seed);
}

TruthOptions truth_options(const Study& config) {
  return {.epsilon_m = config.score.epsilon_m,
          .min_samples = config.score.min_samples,
          .at_s = config.score.at_s,
          .distances = !config.score.distances_m.empty()};
}

TrialRun::TrialRun(const Task& task, const Recording& recording, const ClassTable& table,
                   TruthCache& truths, PoseSources& poses)
    : task_(task),
      table_(table),
      true_(recording.info().calibration),
      believed_(believed_calibration(true_, task)),
      depth_of_(paired_depth(recording, task.config)),
      beliefs_(poses.beliefs(task, depth_of_)),
      depth_dose_(dose_of(task.config.faults.depth)),
      label_dose_(dose_of(task.config.faults.labels)),
      simulated_(simulated_labels(task.config, recording, table)),
      segmentation_(segmentation_params(task.config.methods.front().segmentation)),
      place_voxels_(place_of(task.config, task.config.methods.front()) == Place::voxels),
      fusion_(trial_fusion(task.config.fusion, table)),
      refinement_(trial_refinement(task.config.methods.front().refinement)),
      threshold_(task.config.score.threshold.value.value_or(default_threshold(fusion_.rule))),
      score_options_{positive(task.config.score.tolerances), task.config.score.distances_m,
                     task.config.score.thin},
      map_frame_(map_frame(task.config, task.seed_index)),
      truths_(truths),
      boxes_(truths.boxes()),
      map_(empty_map(task.config.voxel_m, task.config.occupancy)) {
  result_.counts = no_counts();
  if (task.config.score.unit == ScoreUnit::frame) return;
  truth_ = truths.get(map_frame_, truth_options(task.config));
  if (task.config.score.instances)
    instance_truth_ = truths.of_instances(map_frame_, truth_options(task.config));
}

Counts TrialRun::no_counts() const {
  Counts counts = zero_counts(table_.classes.size(), score_options_);
  for (ClassCounts& of_class : counts)
    if (task_.config.score.instances) of_class.instances.emplace();
  return counts;
}

void TrialRun::advance(const Frame& frame) {
  const bool by_itself = task_.config.score.unit == ScoreUnit::frame;
  if (by_itself) map_ = empty_map(task_.config.voxel_m, task_.config.occupancy);
  Counts counts = no_counts();
  times_ = {};
  const bool truth = task_.labels == Labels::truth;
  const cv::Mat1w depth = truth ? frame.depth : corrupted_depth(frame);
  const Observation observation = truth ? observe_truth(frame) : observe(frame, depth, counts);
  const double before_mapping_s = thread_seconds();
  const auto hits = place(observation, sensor_poses(frame.index), map_.edge_m());
  const PosedDepth seen{believed_.depth, mean_sensor_pose(frame.index), believed_.range_min_m,
                        believed_.range_max_m, depth};
  fuse_frame(map_, seen, hits, fusion_.N, fusion_.rule, table_.classes.size());
  map_.add_colours(colours_);
  times_.mapping_s = thread_seconds() - before_mapping_s;
  ++result_.accounting.frames;
  if (by_itself) {
    look_up_truth_of(frame.depth_index);
    score(counts);
  }
  pool_into(result_.counts, counts);
  if (by_itself && keeps_frames_)
    frames_.push_back({frame.index, frame.stamp_s, std::move(counts), times_});
}

TrialResult TrialRun::finish() {
  if (task_.config.score.unit == ScoreUnit::map) score(result_.counts);
  return std::move(result_);
}

cv::Mat1w TrialRun::corrupted_depth(const Frame& frame) const {
  return sim::corrupt_depth(frame.depth, true_.depth, depth_dose_, trial_seed(task_),
                            frame.depth_index);
}

Observation TrialRun::observe(const Frame& frame, const cv::Mat1w& depth, Counts& counts) {
  const std::uint64_t seed = trial_seed(task_);
  const cv::Mat1w label = simulated_ ? simulated_->of(frame) : frame.label;
  const ClassTable& table = simulated_ ? simulated_->table() : table_;
  const std::vector<Detection> detections =
      sim::corrupt_detections(label, table, label_dose_, seed, frame.index);
  note_colours(frame, depth, detections);
  const std::vector<Eigen::AlignedBox3d>& true_boxes = boxes_.of(frame);
  const double before_s = thread_seconds();
  std::vector<Segment> segments =
      segment_frame(detections, depth, believed_, map_.edge_m(), segmentation_, place_voxels_);
  times_.segmentation_s = thread_seconds() - before_s;
  Observation observation;
  for (Segment& found : segments) {
    account(found);
    const bool right = found.class_id == table.class_of(found.instance);
    counts[found.class_id].boxes.add(
        right ? found.box : Eigen::AlignedBox3d(),
        found.instance < true_boxes.size() ? true_boxes[found.instance] : Eigen::AlignedBox3d(),
        0.5 * map_.edge_m());
    observation.push_back({found.class_id, found.score,
                           std::move(place_voxels_ ? found.voxel_centres : found.points)});
  }
  return observation;
}

Observation TrialRun::observe_truth(const Frame& frame) const {
  Observation observation;
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const ClassId class_id = table_.class_of(frame.depth_label(v, u));
      const double z = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (!table_.detected(class_id) || z == 0.0 || z < true_.range_min_m || z > true_.range_max_m)
        continue;
      object_of(class_id, observation).positions.push_back(true_.depth.back_project(u, v, z));
    }
  }
  return observation;
}

void TrialRun::note_colours(const Frame& frame, const cv::Mat1w& depth,
                            const std::vector<Detection>& detections) {
  colours_.clear();
  if (!refinement_ || !refinement_->reads_colour()) return;
  const RegisteredCloud cloud = register_depth(
      depth, believed_, pixels_wanted(detections, frame.color.cols, frame.color.rows));
  const Pose T_map_sensor = mean_sensor_pose(frame.index);
  for (int v = 0; v < frame.color.rows; ++v) {
    for (int u = 0; u < frame.color.cols; ++u) {
      const int source = cloud.source(u, v);
      if (source == RegisteredCloud::kNone) continue;
      const cv::Vec3b bgr = frame.color(v, u);
      colours_.push_back({T_map_sensor * cloud.point(source), {bgr[2], bgr[1], bgr[0]}});
    }
  }
}

Pose TrialRun::mean_sensor_pose(int frame) const {
  const PoseBelief& belief = beliefs_.at(static_cast<std::size_t>(frame));
  return belief.T_map_odom * belief.T_odom_base * believed_.T_base_depth;
}

void TrialRun::account(const Segment& segment) {
  Accounting& accounting = result_.accounting;
  ++accounting.detections;
  accounting.points += static_cast<std::int64_t>(segment.points.size());
  switch (segment.skipped) {
    case SkipReason::none:
      break;
    case SkipReason::no_points:
      ++accounting.skipped_no_points;
      break;
    case SkipReason::eroded_away:
      ++accounting.skipped_eroded_away;
      break;
    case SkipReason::no_seed_point:
      ++accounting.skipped_no_seed_point;
      break;
    case SkipReason::seed_off_object:
      ++accounting.skipped_seed_off_object;
      break;
  }
}

std::vector<Pose> TrialRun::sensor_poses(int frame) const {
  const PoseBelief& belief = beliefs_.at(static_cast<std::size_t>(frame));
  RandomStream stream(trial_seed(task_), "belief", {static_cast<std::uint64_t>(frame)});
  std::vector<Pose> poses =
      draw_poses(belief, fusion_.N, fusion_.noise_at, fusion_.covariance, stream);
  for (Pose& pose : poses) pose = pose * believed_.T_base_depth;
  return poses;
}

void TrialRun::look_up_truth_of(int depth_image) {
  const TruthOptions options = truth_options(task_.config);
  truth_ = truths_.of_frame(map_frame_, options, depth_image);
  if (task_.config.score.instances)
    instance_truth_ = truths_.of_frame_instances(map_frame_, options, depth_image);
}

void TrialRun::score(Counts& counts) {
  if (refinement_) refine(map_, refinement_->rest, refinement_->params);
  const MapSnapshot snapshot(map_.voxels());
  result_.accounting.hits_beyond_span += static_cast<std::int64_t>(map_.hits_beyond_span());
  result_.accounting.map_voxels += static_cast<std::int64_t>(snapshot.voxels().size());
  Counts scored =
      truth_->score(snapshot, threshold_, truth_->view, table_.classes.size(), score_options_);
  if (instance_truth_) {
    const std::vector<InstanceCounts> instances =
        score_instances(pieces_of(snapshot, threshold_), instance_truth_->surface,
                        instance_truth_->view.visible, table_);
    for (std::size_t c = 0; c < scored.size(); ++c) scored[c].instances = instances[c];
  }
  pool_into(counts, scored);
}

}  // namespace mapscore::eval
