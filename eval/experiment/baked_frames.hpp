// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "eval/experiment/study.hpp"
#include "eval/recording/recording.hpp"
#include "sim/faults/depth_dose.hpp"
#include "sim/faults/label_dose.hpp"

#include <cstdint>
#include <optional>

namespace mapscore::eval {

/// Frames with a study's faults of depth and labels in them, for `record --bake`: the images that
/// trials of seed index 0 see. Instance ids show masks, so of the label faults those that change
/// masks are baked; wrong classes and scores are left out. Thread-safe.
class BakedFrames {
 public:
  /// `table`: classes of the scene, before the study's `detect`. Throws Error when the sweep
  /// changes what is to be baked, or nothing is detected.
  BakedFrames(const Study& study, const ClassTable& table, const CameraModel& depth);

  /// What recording.yaml says; none where every dose is zero, and frames stay as they are.
  [[nodiscard]] std::optional<BakedFaults> faults() const;

  /// The colour camera's side with corrupted `label`.
  [[nodiscard]] Frame color(const Frame& exact) const;
  /// The depth camera's side with corrupted `depth`; `depth_label` stays exact.
  [[nodiscard]] Frame depth(const Frame& exact) const;

 private:
  std::uint64_t study_seed_, seed_;
  ClassTable table_;  ///< with the study's `detect`
  CameraModel camera_;
  sim::DepthDose depth_dose_;
  sim::LabelDose label_dose_;
};

/// True where the study's label faults hold what images of instance ids cannot say: wrong classes
/// or scores.
[[nodiscard]] bool has_verdict_faults(const Study& study);

}  // namespace mapscore::eval
