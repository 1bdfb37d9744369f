// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/frame.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/recording/frame_cache.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/plan.hpp"

#include <cstddef>
#include <functional>
#include <memory>

namespace mapscore::eval {

/// A recording with all that trials over it share: decoded frames, truths, poses. `recording` and
/// `table` must outlive it. What it gives is safe from several threads.
class Bench {
 public:
  /// `table` has the study's detected set. `colour`: whether some trial reads colour images.
  /// `lattices`: truths of so many lattices are kept at once.
  Bench(const Recording& recording, const ClassTable& table, bool colour, std::size_t memory_bytes,
        std::size_t lattices = 1);

  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const ClassTable& table() const { return table_; }

  /// A trial at its first frame; `task` must outlive it. `sights`: as TrialRun.
  [[nodiscard]] std::unique_ptr<TrialRun> start(const Task& task,
                                                std::shared_ptr<const Sights> sights = {});
  [[nodiscard]] std::shared_ptr<const Frame> frame(int index, int depth_index);
  /// Takes a trial over all frames; `shown(done, all)` after each.
  void run(TrialRun& trial, const std::function<void(int, int)>& shown = {});

 private:
  const Recording& recording_;
  const ClassTable& table_;
  FrameCache frames_;
  TruthCache truths_;
  PoseSources poses_;
};

}  // namespace mapscore::eval
