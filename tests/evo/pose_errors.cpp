// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// mapscore_pose_errors TRUTH BELIEVED...: for each believed trajectory, a file in the format of TUM
// with as many poses as that of the truth, a line of its figures, as localization_scores.csv has
// them. compare.py holds them against evo's.

#include "core/error.hpp"
#include "eval/localization/trajectory_errors.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/score/part_counts.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <span>
#include <vector>

namespace mapscore::eval {
namespace {

std::vector<Pose> poses_of(const std::filesystem::path& file) {
  std::vector<Pose> poses;
  for (const TrajectoryPose& line : read_trajectory(file)) poses.push_back(line.T_world_base);
  return poses;
}

void print(const TrajectoryErrors& errors) {
  std::cout << fmt::format("pairs={}", errors.relative_position.count);
  for (const Metric& metric : pose_metrics(errors))
    if (metric.value) std::cout << fmt::format(",{}={}", metric.name, *metric.value);
  std::cout << '\n';
}

}  // namespace
}  // namespace mapscore::eval

int main(int count, char** words) try {
  using namespace mapscore::eval;
  const std::span<char*> files(words + 1, words + count);
  if (files.size() < 2) throw mapscore::Error("usage: mapscore_pose_errors TRUTH BELIEVED...");
  const std::vector<mapscore::Pose> truth = poses_of(files.front());
  for (const char* file : files.subspan(1)) print(trajectory_errors(truth, poses_of(file)));
  return 0;
} catch (const mapscore::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
