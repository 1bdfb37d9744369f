// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/shape.hpp"
#include "core/mapping/mapped_frames.hpp"
#include "core/segmentation/segmentation.hpp"
#include "core/segmentation/sight.hpp"
#include "eval/foreign/network_labels.hpp"
#include "eval/lab/shared_cache.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/calibration_counts.hpp"
#include "eval/results/task_list.hpp"
#include "eval/study/study.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// The networks whose labels a recording's trials read, each once: its classes, list and scores.
using Networks = SharedCache<NetworkImages, std::shared_ptr<const NetworkLabels>>;

/// Makes what the methods of a trial see of a recording's frames: every fault of calibration, depth
/// and labels comes in here. Trials with equal keys see the same. Immutable, safe to share between
/// threads; `recording` and `table` must outlive it, `networks` need not.
class Sights {
 public:
  /// Throws Error when the objects of simulated perception are refused or too many, or there is
  /// neither a file of them nor truth, or a network's classes, scores or list are refused. Reads
  /// the frames that a calibration is estimated from.
  /// `networks`: of this recording and table; without them it reads its own.
  Sights(const Task& task, const Recording& recording, const ClassTable& table,
         Networks* networks = nullptr);
  /// Of a camera that has recorded nothing yet, among `shapes` that do not move: each colour image
  /// is read with the depth image of its number. `table` must outlive it. Throws Error when a
  /// network, a time offset or an estimate of the calibration would need a recording, or as above.
  Sights(const Task& task, const Calibration& truth, const std::vector<Shape>& shapes,
         const ClassTable& table);

  /// Equal for tasks of one plan and seed where their sights are: what of a configuration decides
  /// them.
  [[nodiscard]] static std::string key(const Study& config, Labels labels);

  /// The depth image that a frame is paired with under the trial's time offset.
  [[nodiscard]] int depth_of(int frame) const {
    return is_live_ ? frame : depth_of_.at(static_cast<std::size_t>(frame));
  }
  [[nodiscard]] const std::vector<int>& depth_of_frames() const { return depth_of_; }
  /// The table of the instances in the detections: the recording's, or that of simulated
  /// perception. A network's detections are instances beyond it.
  [[nodiscard]] const ClassTable& table() const;

  [[nodiscard]] const Calibration& believed() const { return believed_; }
  /// How the estimate of it came out, where it is estimated.
  [[nodiscard]] const std::optional<CalibrationCounts>& calibrated() const { return calibrated_; }
  /// The same for people, with the reason of a refusal; empty where it is not estimated.
  [[nodiscard]] const std::string& calibration_note() const { return calibration_note_; }

  /// Whether the method sees the recording's own depth images, and whether its label images, whose
  /// ids may then mean other classes and scores but where keeps_verdicts.
  [[nodiscard]] bool keeps_depth() const;
  [[nodiscard]] bool keeps_labels() const;
  [[nodiscard]] bool keeps_verdicts() const;

  /// What a method sees of a frame, which is read with the depth image that `depth_of` names. Of
  /// the lattice ceiling: the exact depth image and no detections. Throws Error where a network's
  /// image cannot be read.
  [[nodiscard]] Sight of(const Frame& frame) const;

  /// The same of a frame that is read from the recording. Throws Error as it does, too.
  [[nodiscard]] Sight read(const Recording& recording, int frame) const;

  /// What a first look at the recording's frames tells. Made once for each segmentation. Throws
  /// Error as `read`.
  [[nodiscard]] CalibrationEvidence told(const Recording& recording,
                                         const Segmentation& segmentation,
                                         const MappedFrames& mapped) const;

  /// How sure a network was of each pixel of a frame, before any fault of labels; none where no
  /// network says so. Throws Error likewise.
  [[nodiscard]] std::optional<PixelVerdicts> verdicts_of(int frame) const {
    return network_ ? network_->verdicts_of(frame) : std::nullopt;
  }

 private:
  class SimulatedLabels;

  [[nodiscard]] std::vector<Detection> detections_of(const Frame& frame) const;
  /// Replaces what is believed by what the recording's own frames tell, if they do.
  void calibrate(const Recording& recording, const CalibratorSettings& settings);

  const ClassTable& table_;
  Labels labels_;
  std::uint64_t seed_;
  CameraModel depth_camera_;  ///< true
  Calibration believed_;      ///< what the method believes of the cameras
  std::optional<CalibrationCounts> calibrated_;
  std::string calibration_note_;
  std::vector<int> depth_of_;  ///< by frame, of a recording
  bool is_live_ = false;       ///< no recording
  FaultSettings faults_;
  std::shared_ptr<const SimulatedLabels> simulated_;  ///< in place of the recording's labels
  std::shared_ptr<const NetworkLabels> network_;      ///< likewise
  mutable SharedCache<std::pair<Segmentation, MappedFrames>, CalibrationEvidence> told_{4};
};

/// What is seen at so many of these frames at most that show objects, spread evenly, by frame: what
/// a calibration is estimated from. Throws Error as `sight`.
[[nodiscard]] std::map<int, Sight> sights_of_objects(const std::vector<int>& frames, int most,
                                                     const std::function<Sight(int)>& sight);

/// What some of these frames that show objects, spread evenly, tell together of the believed
/// calibration, so that the first frames of a map know what later ones show; closed. Nothing, and
/// open, where the segmentation does not mend the calibration, or where key frames alone are
/// mapped, since the others are to change nothing. Throws Error as `sight`.
[[nodiscard]] CalibrationEvidence first_look(const Segmentation& segmentation,
                                             const MappedFrames& mapped,
                                             const Calibration& believed,
                                             const std::vector<int>& frames,
                                             const std::function<Sight(int)>& sight);

/// The true calibration with a task's calibration faults: what its method believes, or where the
/// calibration is estimated, what the estimate starts from.
[[nodiscard]] Calibration believed_calibration(const Calibration& truth, const Task& task);

}  // namespace mapscore::eval
