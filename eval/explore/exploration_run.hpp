// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/explorer.hpp"
#include "eval/explore/exploration_result.hpp"
#include "eval/explore/visible_surface.hpp"
#include "eval/recording/recording_writer.hpp"
#include "eval/results/task_list.hpp"
#include "sim/robot/drive_model.hpp"
#include "sim/world/world.hpp"

#include <cstdint>
#include <functional>
#include <memory>

namespace mapscore::eval {

/// What an exploration runs in; must outlive it.
struct ExplorationStage {
  const sim::World& world;
  const sim::DriveModel& drive;
  const ClassTable& table;        ///< with the study's detected classes
  const VisibleSurface& surface;  ///< on the lattice of the task's map
};

/// Who decides, made when robot and map frame are known. `seed`: of what is drawn.
using MakeExplorer =
    std::function<std::unique_ptr<Explorer>(const ExploringRobot& robot, const Pose& T_map_world)>;

/// Where an exploration's frames and state go.
struct ExplorationSinks {
  RecordingWriter* recording = nullptr;
  /// After each frame, with its number; the image is read-only.
  std::function<void(const Frame& frame, const SemanticMap& map)> frame = {};
  /// After each frame; may throw to stop the exploration.
  std::function<void(const CoveragePoint& point)> progress = {};
  /// Once, at the end.
  std::function<void(const SemanticMap& map)> map = {};
};

/// Drives, renders, maps and chooses until nothing is left, nothing can be reached, or the budget
/// of the task's configuration is used up (docs/exploration.md). Frames under the task's faults and
/// pose source become the same map as `mapscore run` makes of the recording. The same bytes each
/// time. Throws Error where the pose source or the perception needs a whole recording, or the
/// robot falls.
[[nodiscard]] ExplorationResult explore(const ExplorationStage& stage, const Task& task,
                                        const PlanarPose& start, const MakeExplorer& make_explorer,
                                        const ExplorationSinks& sinks);

}  // namespace mapscore::eval
