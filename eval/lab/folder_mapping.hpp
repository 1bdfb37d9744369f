// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "core/mapping/mapper.hpp"
#include "core/mapping/semantic_map.hpp"
#include "eval/foreign/labelled_folder.hpp"
#include "eval/foreign/trial_folder.hpp"
#include "eval/study/study.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace mapscore::eval {

/// How a folder is mapped: its calibration and poses are believed as they are.
struct FolderMapping {
  Mapping mapping;                      ///< without covariances, of one draw a frame
  Pose T_map_world = Pose::Identity();  ///< world: the frame of groundtruth.txt
  Refinement refinement;                ///< of the finished map; without colours but in trials
};

/// What came of the frames.
struct MappedCounts {
  std::int64_t frames = 0, detections = 0, points = 0;
  std::int64_t left_out = 0;          ///< of the frames: no key frames, so not mapped
  std::int64_t unsure = 0;            ///< of the frames: mended with a confidence below 0.5
  std::int64_t empty = 0;             ///< detections that yielded nothing
  std::int64_t hits_beyond_span = 0;  ///< left out: the octree does not reach so far
};

/// Told after each frame: how many are done, of how many.
using FramesDone = std::function<void(int, int)>;

/// What a method sees of a frame of a folder. Throws Error where an image cannot be read.
[[nodiscard]] Sight sight_of(const LabelledFolder& folder, int index);

/// Maps these frames of a folder in their order, as a trial at dose zero does. Throws Error where
/// an image cannot be read or a parameter is out of range.
[[nodiscard]] SemanticMap map_folder(const LabelledFolder& folder, const std::vector<int>& frames,
                                     const FolderMapping& mapping, MappedCounts& counts,
                                     const FramesDone& shown);

/// Maps these frames of a trial folder, by their position in its list; all of them give the map of
/// the trial, bit for bit, where `mapping` is that of its method.yaml. Throws Error likewise.
[[nodiscard]] SemanticMap map_trial(const TrialFolder& folder, const std::vector<int>& frames,
                                    const FolderMapping& mapping, MappedCounts& counts,
                                    const FramesDone& shown);

}  // namespace mapscore::eval
