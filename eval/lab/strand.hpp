// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/bench.hpp"
#include "eval/results/task_list.hpp"

#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Trials whose methods see the same, under way together: what they see of a frame is made once. A
/// trial that throws is let go, and failed(task, reason) called; the others go on. Used by one
/// thread at a time.
class Strand {
 public:
  explicit Strand(std::vector<std::size_t> positions) : positions_(std::move(positions)) {}

  [[nodiscard]] std::size_t planned() const { return positions_.size(); }
  /// How many are under way.
  [[nodiscard]] std::size_t size() const { return trials_.size(); }

  void start(const TaskList& tasks, Bench& bench, const auto& failed) {
    started_ = true;
    for (const std::size_t position : positions_)
      trials_.push_back({std::make_unique<const Task>(tasks[position]), nullptr});
    std::shared_ptr<const Sights> sights;
    each(failed, [&](Trial& trial) {
      trial.run = bench.start(*trial.task, sights);
      sights = trial.run->sights();
    });
  }
  [[nodiscard]] bool started() const { return started_; }

  void advance(Bench& bench, int index, const auto& failed) {
    std::shared_ptr<const Frame> frame;
    std::optional<Sight> sight;
    const auto see = [&](const Sights& sights) {
      frame = bench.frame(index, sights.depth_of(index));
      sight.emplace(sights.of(*frame));
    };
    each(failed, [&](Trial& trial) {
      if (!sight) see(*trial.run->sights());
      trial.run->advance(*frame, *sight);
    });
  }

  /// Scores the maps and lets go of them: done(task, result) for each trial.
  void finish(const auto& done, const auto& failed) {
    TrialResult result;
    each(
        failed,
        [&](Trial& trial) {
          result = trial.run->finish();
          trial.run.reset();
        },
        [&](const Trial& trial) { done(*trial.task, result); });
    trials_.clear();
  }

 private:
  struct Trial {
    std::unique_ptr<const Task> task;
    std::unique_ptr<TrialRun> run;
  };

  /// work(trial) of each trial, and then(trial) where it did not throw; what `then` throws is not
  /// the trial's failure.
  void each(const auto& failed, const auto& work, const auto& then) {
    std::erase_if(trials_, [&](Trial& trial) {
      try {
        work(trial);
      } catch (const std::bad_alloc&) {
        throw;  // not this trial's fault
      } catch (const std::exception& error) {
        failed(*trial.task, error.what());
        return true;
      }
      then(trial);
      return false;
    });
  }
  void each(const auto& failed, const auto& work) {
    each(failed, work, [](const Trial&) {});
  }

  std::vector<std::size_t> positions_;
  std::vector<Trial> trials_;
  bool started_ = false;
};

/// Strands of at most `most` trials, fewer where they carve. `missing`: positions of tasks, those
/// of one lattice together. So many `lattices` at a time take turns, each with its strands in the
/// order of the first trial of each, so that threads do not wait for the truth of the same one.
[[nodiscard]] std::vector<Strand> strands_of(const TaskList& tasks,
                                             const std::vector<std::size_t>& missing,
                                             std::size_t most, std::size_t lattices = 1);

}  // namespace mapscore::eval
