// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/trial_run.hpp"
#include "eval/recording/frame_cache.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace mapscore::eval {

/// A recording with all that trials over it share: decoded frames, truths, poses, networks.
/// `recording` and `table` must outlive it. What it gives is safe from several threads.
class Bench {
 public:
  /// `table` has the study's detected set. `colour`: whether some trial reads colour images.
  /// `lattices`: truths of so many lattices are kept at once.
  Bench(const Recording& recording, const ClassTable& table, bool colour, std::size_t memory_bytes,
        std::size_t lattices = 1)
      : recording_(recording),
        table_(table),
        frames_(recording, {.color = colour, .label = true, .depth = true, .depth_label = true},
                memory_bytes),
        truths_(recording, table, frames_, lattices),
        poses_(recording) {}

  [[nodiscard]] const Recording& recording() const { return recording_; }
  [[nodiscard]] const ClassTable& table() const { return table_; }

  /// A trial at its first frame; `task` must outlive it. `sights`: as TrialRun, with the shared
  /// networks.
  [[nodiscard]] std::unique_ptr<TrialRun> start(const Task& task,
                                                std::shared_ptr<const Sights> sights = {}) {
    if (!sights) sights = std::make_shared<Sights>(task, recording_, table_, &networks_);
    return std::make_unique<TrialRun>(task, recording_, table_, truths_, poses_, std::move(sights));
  }
  [[nodiscard]] std::shared_ptr<const Frame> frame(int index, int depth_index) {
    return frames_.get(index, depth_index);
  }
  /// Takes a trial over all frames; `shown(done, all)` after each.
  void run(TrialRun& trial, const std::function<void(int, int)>& shown = {}) {
    const int all = recording_.frame_count();
    for (int index = 0; index < all; ++index) {
      trial.advance(*frame(index, trial.depth_of(index)));
      if (shown) shown(index + 1, all);
    }
  }

 private:
  static constexpr std::size_t kNetworks = 64;  ///< kept at once

  const Recording& recording_;
  const ClassTable& table_;
  FrameCache frames_;
  TruthCache truths_;
  PoseSources poses_;
  Networks networks_{kNetworks};
};

}  // namespace mapscore::eval
