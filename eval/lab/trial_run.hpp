// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/mapper.hpp"
#include "core/placement/placement.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/lab/sights.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/results/store.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// One frame that was scored by itself.
struct FrameResult {
  int frame = 0;  ///< index in the recording
  double stamp_s = 0.0;
  Counts counts;  ///< by class id
  FrameTimes times;
};

/// One running trial: takes the frames of a recording in order and ends in counts. Used by one
/// thread at a time; `task`, `recording`, `table` and `truths` must outlive it, `poses` need not.
class TrialRun {
 public:
  /// `sights`: shared with trials of an equal Sights::key; without them it makes its own.
  TrialRun(const Task& task, const Recording& recording, const ClassTable& table,
           TruthCache& truths, PoseSources& poses, std::shared_ptr<const Sights> sights = {});
  /// A temporary task would not outlive it.
  TrialRun(Task&& task, const Recording& recording, const ClassTable& table, TruthCache& truths,
           PoseSources& poses, std::shared_ptr<const Sights> sights = {}) = delete;

  /// Keeps the counts of each frame, where each is scored by itself. Call it before the first one.
  void keep_frames() { keeps_frames_ = true; }

  /// The depth image that a frame is paired with under the trial's time offset.
  [[nodiscard]] int depth_of(int frame) const { return sights_->depth_of(frame); }

  /// Register, segment, place and fuse one frame under the trial's faults; and score it, where each
  /// frame is scored by itself. It is read with the depth image that `depth_of` names.
  void advance(const Frame& frame) { advance(frame, sights_->of(frame)); }
  /// The same, with what sights() make of the frame.
  void advance(const Frame& frame, const Sight& sight);
  [[nodiscard]] const std::shared_ptr<const Sights>& sights() const { return sights_; }

  /// Scores the map and gives the counts of the whole trial.
  [[nodiscard]] TrialResult finish();
  /// In place of advance: counts a frame's detections in its image, where the study asks for that.
  void count_labels(const Frame& frame, const Sight& sight);
  /// In place of advance and finish: scores a map of all frames that was made elsewhere, by a
  /// command.
  [[nodiscard]] TrialResult judge(const MapSnapshot& map);
  /// What is believed at every frame.
  [[nodiscard]] const std::vector<PoseBelief>& beliefs() const { return beliefs_; }

  /// What was kept, in the order of the frames; added up, the counts of the trial, but for its
  /// poses, which are of no frame.
  [[nodiscard]] const std::vector<FrameResult>& frames() const { return frames_; }
  /// Moves the kept frames out.
  [[nodiscard]] std::vector<FrameResult> take_frames() { return std::exchange(frames_, {}); }

  /// The map as it stands; of the last frame where each is scored by itself.
  [[nodiscard]] const SemanticMap& map() const { return mapper_.map(); }
  [[nodiscard]] double threshold() const { return threshold_; }
  /// What the map is scored against; of the last frame where each is scored by itself.
  [[nodiscard]] const LatticeTruth& truth() const { return *truth_; }

 private:
  /// Counts a frame's detections and their boxes; one of a wrong class has no box there.
  void count(const std::vector<Segment>& segments,
             const std::vector<Eigen::AlignedBox3d>& true_boxes, Counts& counts);
  /// Errors of the beliefs of all frames, in the scene's world.
  [[nodiscard]] PoseCounts score_poses(const Recording& recording) const;
  /// What the lattice ceiling maps: every depth pixel of a detected instance, under its true class.
  void score_labels(const Frame& frame, const Sight& sight, Counts& counts) const;
  [[nodiscard]] Observation observe_truth(const Frame& frame) const;
  /// Adds the counts of the map as it stands, or of another.
  void score(Counts& counts);
  void score(const MapSnapshot& snapshot, Counts& counts);
  /// Takes the truth of the map, or of the frame that is read with a depth image.
  void look_up_truth(std::optional<int> depth_image);

  const Task& task_;
  const ClassTable& table_;
  Calibration true_;  ///< what rendered the images
  std::shared_ptr<const Sights> sights_;
  std::vector<PoseBelief> beliefs_;  ///< by frame
  Mapping mapping_;
  double threshold_;
  ScoreOptions score_options_;
  MapFrame map_frame_;
  TruthCache& truths_;
  std::shared_ptr<const LatticeTruth> truth_;
  std::shared_ptr<const LatticeTruth> instance_truth_;  ///< none where instances are not scored
  Mapper mapper_;
  TrialResult result_;
  bool keeps_frames_ = false;
  std::vector<FrameResult> frames_;
};

}  // namespace mapscore::eval
