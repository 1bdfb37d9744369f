// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/trial_run.hpp"

#include "core/error.hpp"
#include "core/refinement/map_refinement.hpp"
#include "eval/lab/detected_samples.hpp"
#include "eval/score/detection_score.hpp"
#include "eval/score/instances/instance_score.hpp"

#include <fmt/format.h>

namespace mapscore::eval {
namespace {

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

TrialRun::TrialRun(const Task& task, const Recording& recording, const ClassTable& table,
                   TruthCache& truths, PoseSources& poses, std::shared_ptr<const Sights> sights)
    : task_(task),
      table_(table),
      true_(recording.info().calibration),
      sights_(sights ? std::move(sights) : std::make_shared<Sights>(task, recording, table)),
      mapping_(mapping_of(task.config, table)),
      threshold_(
          task.config.score.threshold.value.value_or(default_threshold(mapping_.fusion.rule))),
      score_options_{positive(task.config.score.tolerances), task.config.score.distances_m,
                     task.config.score.asked},
      map_frame_(map_frame(task.config, task.seed_index)),
      truths_(truths),
      mapper_(mapping_, table.classes.size(),
              task.config.score.unit == ScoreUnit::map
                  ? sights_->told(recording, mapping_.segmentation, mapping_.frames)
                  : CalibrationEvidence()) {
  TrialPoses believed = poses.poses(task, sights_->depth_of_frames());
  beliefs_ = std::move(believed.beliefs);
  result_.accounting.tracking = believed.tracking;
  result_.accounting.calibration = sights_->calibrated();
  result_.counts = zero_counts(table_.classes.size(), score_options_);
  if (score_options_.asked.poses) result_.counts[kBackground].poses = score_poses(recording);
  if (task.config.score.unit == ScoreUnit::map) look_up_truth({});
}

PoseCounts TrialRun::score_poses(const Recording& recording) const {
  const Pose T_world_map = map_frame_.T_map_world().inverse();
  std::vector<PoseBelief> believed = beliefs_;
  for (PoseBelief& belief : believed) belief.T_map_odom = T_world_map * belief.T_map_odom;
  return PoseCounts::of(
      trajectory_errors(true_poses(recording, task_, sights_->depth_of_frames()), believed));
}

void TrialRun::advance(const Frame& frame, const Sight& sight) {
  if (const MethodSettings& method = task_.config.methods.front(); method.command)
    throw Error(fmt::format(
        "methods.{0}: is a command, which `sweep` alone runs; `mapscore trial --method {0}` writes "
        "what it is given",
        method.name));
  const bool by_itself = task_.config.score.unit == ScoreUnit::frame;
  if (by_itself) mapper_ = Mapper(mapping_, table_.classes.size());
  Counts counts = zero_counts(table_.classes.size(), score_options_);
  const PoseBelief& belief = beliefs_.at(static_cast<std::size_t>(frame.index));
  RandomStream draws(trial_seed(task_), "belief", {static_cast<std::uint64_t>(frame.index)});
  if (task_.labels == Labels::truth) {
    mapper_.fuse(observe_truth(frame), sight, belief, draws);
  } else if (mapper_.takes(sight, belief)) {
    count(mapper_.integrate(sight, belief, draws), truths_.boxes_of(frame), counts);
    if (reads_colour(task_.config)) mapper_.add_colours(sight, frame.color, belief);
  } else {
    ++result_.accounting.frames_left_out;
  }
  if (score_options_.asked.labels && task_.labels == Labels::detected)
    score_labels(frame, sight, counts);
  ++result_.accounting.frames;
  if (by_itself) {
    look_up_truth(frame.depth_index);
    score(counts);
  }
  pool_into(result_.counts, counts);
  if (by_itself && keeps_frames_)
    frames_.push_back({frame.index, frame.stamp_s, std::move(counts), mapper_.times()});
}

void TrialRun::count_labels(const Frame& frame, const Sight& sight) {
  if (score_options_.asked.labels) score_labels(frame, sight, result_.counts);
}

void TrialRun::score_labels(const Frame& frame, const Sight& sight, Counts& counts) const {
  score_detections(sight.detections(), frame.label, table_, counts);
  if (const auto verdicts = sights_->verdicts_of(frame.index))
    score_pixels(verdicts->classes, verdicts->thousandths, frame.label, table_, counts);
}

TrialResult TrialRun::judge(const MapSnapshot& map) {
  result_.accounting.frames = static_cast<std::int64_t>(beliefs_.size());
  score(map, result_.counts);
  return std::move(result_);
}

TrialResult TrialRun::finish() {
  if (task_.config.score.unit == ScoreUnit::map) score(result_.counts);
  return std::move(result_);
}

void TrialRun::count(const std::vector<Segment>& segments,
                     const std::vector<Eigen::AlignedBox3d>& true_boxes, Counts& counts) {
  Accounting& accounting = result_.accounting;
  if (is_unsure(segments)) ++accounting.frames_unsure;
  for (const Segment& found : segments) {
    ++accounting.detections;
    accounting.points += static_cast<std::int64_t>(found.points.size());
    if (const auto skipped = Accounting::of(found.skipped)) ++(accounting.*skipped);
    const bool right = found.class_id == sights_->table().class_of(found.instance);
    counts[found.class_id].boxes.add(
        right ? found.box : Eigen::AlignedBox3d(),
        found.instance < true_boxes.size() ? true_boxes[found.instance] : Eigen::AlignedBox3d(),
        0.5 * mapping_.voxel_m);
  }
}

Observation TrialRun::observe_truth(const Frame& frame) const {
  Observation observation;
  for_each_detected_sample(frame, true_, table_,
                           [&](ClassId class_id, const Eigen::Vector3d& p_depth) {
                             object_of(class_id, observation).positions.push_back(p_depth);
                           });
  return observation;
}

void TrialRun::look_up_truth(std::optional<int> depth_image) {
  const ScoreSettings& settings = task_.config.score;
  const TruthOptions options{.epsilon_m = settings.epsilon_m,
                             .min_samples = settings.min_samples,
                             .at_s = settings.at_s,
                             .distances = !settings.distances_m.empty(),
                             .depth_image = depth_image};
  truth_ = truths_.get(map_frame_, options);
  if (score_options_.asked.instances) instance_truth_ = truths_.of_instances(map_frame_, options);
}

void TrialRun::score(Counts& counts) {
  SemanticMap& map = mapper_.map();
  if (const auto* crf = std::get_if<Crf>(&task_.config.methods.front().refinement))
    refine(map, *crf);
  result_.accounting.hits_beyond_span += static_cast<std::int64_t>(map.hits_beyond_span());
  score(MapSnapshot(map.voxels()), counts);
}

void TrialRun::score(const MapSnapshot& snapshot, Counts& counts) {
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
