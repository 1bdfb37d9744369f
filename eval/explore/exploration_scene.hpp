// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_study.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace mapscore::eval {

/// The scenes of a study's explorations, each compiled once, with where the robot can stand and
/// what of them can be seen. Clouds of visible surfaces are kept below `surfaces` of the folder.
/// Safe to use from several threads. Throws Error when the program was built without the simulator.
class ExplorationScenes {
 public:
  explicit ExplorationScenes(std::filesystem::path folder);
  ~ExplorationScenes();
  ExplorationScenes(const ExplorationScenes&) = delete;
  ExplorationScenes& operator=(const ExplorationScenes&) = delete;

  /// An exploration whose scene is there and whose robot stands at its start.
  struct Ready {
    std::string key;           ///< hash of all that decides it
    std::string key_of_other;  ///< the same with a recording where it keeps none, and the reverse
    PlanarPose start;
    bool records = true;
  };

  /// Throws Error where the scene is refused, it has no place to stand, or the start is none.
  [[nodiscard]] Ready ready(const PlannedExploration& planned, bool records);

  /// Explores, and writes all its files into a folder that is there.
  void run(const PlannedExploration& planned, const Ready& ready,
           const std::filesystem::path& folder,
           const std::function<void(const CoveragePoint&)>& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapscore::eval
