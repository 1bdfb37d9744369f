// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/sights.hpp"

#include "sim/faults/calibration_faults.hpp"
#include "sim/faults/depth_noise.hpp"
#include "sim/faults/label_noise.hpp"

#include <utility>

namespace mapscore::eval {
namespace {

/// The depth image of every frame under the time offset.
std::vector<int> paired_depth(const Recording& recording, const Study& config) {
  std::vector<int> depth;
  for (int frame = 0; frame < recording.frame_count(); ++frame)
    depth.push_back(recording.depth_of(frame, config.faults.time_offset_ms / 1000.0));
  return depth;
}

}  // namespace

Calibration believed_calibration(const Calibration& truth, const Task& task) {
  const std::uint64_t seed = trial_seed(task);
  const Calibration misregistered =
      sim::misregister(truth, task.config.faults.misregistration, seed);
  return sim::misplace_mount(misregistered, task.config.faults.mount, seed);
}

Sights::Sights(const Task& task, const Recording& recording, const ClassTable& table)
    : table_(table),
      labels_(task.labels),
      seed_(trial_seed(task)),
      depth_camera_(recording.info().calibration.depth),
      believed_(believed_calibration(recording.info().calibration, task)),
      depth_of_(paired_depth(recording, task.config)),
      faults_(task.config.faults),
      simulated_(simulated_labels(task.config, recording, table)) {}

std::string Sights::key(const Study& config, Labels labels) {
  Study seen;
  seen.seed = config.seed;
  seen.faults = with_canonical_doses(config.faults);
  seen.faults.pose = {};
  seen.faults.lidar = {};
  seen.perception = config.perception;
  return (labels == Labels::truth ? "truth\n" : "detected\n") + to_yaml(seen);
}

const ClassTable& Sights::table() const {
  return simulated_ ? simulated_->table() : table_;
}

Sight Sights::of(const Frame& frame) const {
  if (labels_ == Labels::truth) return {believed_, frame.depth, {}};
  return {believed_,
          sim::corrupt_depth(frame.depth, depth_camera_, faults_.depth.dose(), seed_,
                             frame.depth_index),
          sim::corrupt_detections(simulated_ ? simulated_->of(frame) : frame.label, table(),
                                  faults_.labels.dose(), seed_, frame.index)};
}

}  // namespace mapscore::eval
