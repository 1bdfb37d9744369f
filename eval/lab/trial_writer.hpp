// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/placement/pose_belief.hpp"
#include "eval/lab/sights.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/task_list.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace mapscore::eval {

/// Everything that the method of a trial is given.
struct GivenTrial {
  const Task& task;
  const Recording& recording;
  const Sights& sights;
  const std::vector<PoseBelief>& beliefs;  ///< by frame, as PoseSources gives them
  std::filesystem::path images;            ///< holds the recording's files, under their own paths
  /// The frame of a colour image with a depth image, for those that a dose touches.
  std::function<std::shared_ptr<const Frame>(int index, int depth_index)> frame;
};

/// Writes what the method of a trial sees, and nothing of the truth, into a folder that is there
/// and empty (docs/formats.md, Trial folder). Images that no dose touches are links to those in
/// `images`, or copies where there can be no links. Throws Error where a file cannot be written, an
/// image is refused, or each frame is scored by itself.
void write_trial(const GivenTrial& given, const std::filesystem::path& folder);

}  // namespace mapscore::eval
