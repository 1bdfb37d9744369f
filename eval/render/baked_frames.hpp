// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/frame.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"
#include "sim/faults/image_doses.hpp"

#include <cstdint>
#include <optional>

namespace mapscore::eval {

/// Applies a study's faults of depth and labels to frames, for `record --bake`: gives the images
/// that trials of seed index 0 see. Label images hold instance ids, so only label faults that
/// change masks are applied; wrong classes and scores are not. Thread-safe.
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
