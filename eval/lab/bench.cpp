// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/bench.hpp"

#include <utility>

namespace mapscore::eval {

Bench::Bench(const Recording& recording, const ClassTable& table, bool colour,
             std::size_t memory_bytes, std::size_t lattices)
    : recording_(recording),
      table_(table),
      frames_(recording, {.color = colour, .label = true, .depth = true, .depth_label = true},
              memory_bytes),
      truths_(recording, table, frames_, lattices),
      poses_(recording) {}

std::unique_ptr<TrialRun> Bench::start(const Task& task, std::shared_ptr<const Sights> sights) {
  return std::make_unique<TrialRun>(task, recording_, table_, truths_, poses_, std::move(sights));
}

std::shared_ptr<const Frame> Bench::frame(int index, int depth_index) {
  return frames_.get(index, depth_index);
}

void Bench::run(TrialRun& trial, const std::function<void(int, int)>& shown) {
  const int all = recording_.frame_count();
  for (int index = 0; index < all; ++index) {
    trial.advance(*frame(index, trial.depth_of(index)));
    if (shown) shown(index + 1, all);
  }
}

}  // namespace mapscore::eval
