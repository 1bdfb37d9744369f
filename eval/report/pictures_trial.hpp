// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/geometry/pose.hpp"
#include "eval/experiment/grid.hpp"
#include "eval/experiment/study.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/pictures_judgement.hpp"

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Which trials are drawn: all methods at one cell with one seed.
struct PictureChoice {
  std::vector<std::pair<std::string, std::string>>
      doses;                          ///< swept path and value; others: the middle one
  std::optional<std::string> method;  ///< only this one
  int seed_index = 0;
  std::size_t memory_bytes = std::size_t{1} << 30;  ///< decoded frames held at once
};

/// The map that one trial ended with (of its fullest frame where each is scored by itself), judged.
struct TrialMap {
  std::string method;
  Cell cell;
  int seed_index = 0;
  std::optional<int> frame;  ///< where each frame is scored by itself
  double edge_m = 0.05;
  Pose T_world_map = Pose::Identity();
  std::vector<JudgedVoxel> voxels;
  Eigen::AlignedBox3d seen_map;  ///< bounds of everything visible, frame map
};

/// The cell of the sweep with the chosen doses. Throws Error naming a path or value that is not
/// swept.
[[nodiscard]] Cell chosen_cell(const Study& study, const PictureChoice& choice);

/// Runs the chosen trials over the recording. Throws Error when there is no such trial.
[[nodiscard]] std::vector<TrialMap> map_trials(const Study& study, const ClassTable& table,
                                               const Recording& recording,
                                               const PictureChoice& choice);

/// The frame of first..end-1 with most colour pixels of detected classes; the earliest of equals.
[[nodiscard]] int fullest_frame(const Recording& recording, const ClassTable& table, int first,
                                int end);

}  // namespace mapscore::eval
