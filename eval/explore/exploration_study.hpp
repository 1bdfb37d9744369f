// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_files.hpp"
#include "eval/study/grid.hpp"
#include "eval/study/study.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// One exploration of a study: a method at a cell with a seed.
struct PlannedExploration {
  TrialSpec spec;
  std::string name;  ///< of its folder: scene, doses, method and seed, as far as they vary
  Study config;      ///< resolved: one scene, one method, no sweep
};

/// All of them. Throws Error where nobody explores, a recording would be replayed, the map does not
/// carve, something moves, or images of a pair would differ in their stamps.
[[nodiscard]] std::vector<PlannedExploration> explorations(const Study& study);

/// What became of one of them.
struct FinishedExploration {
  PlannedExploration planned;
  KeptExploration kept;
  std::filesystem::path folder;
};

struct ExploreOptions {
  std::filesystem::path folder;  ///< of the study's explorations
  int jobs = 1;
  bool keep_recordings = true;
};

/// Called after a frame of an exploration, by its position in the list, and once with its last
/// frame when it has `ended`, or was there. May throw to stop all.
using ExploreProgress =
    std::function<void(std::size_t position, const CoveragePoint& point, bool ended)>;

/// Runs those that the folder does not hold yet, up to `jobs` at a time, each of them in a folder
/// of its own below `runs`, written aside and renamed. In their order; the same bytes for any
/// number of jobs. Throws Error also where a folder holds an exploration of another study.
[[nodiscard]] std::vector<FinishedExploration> explore_all(
    const std::vector<PlannedExploration>& planned, const ExploreOptions& options,
    const ExploreProgress& progress);

}  // namespace mapscore::eval
