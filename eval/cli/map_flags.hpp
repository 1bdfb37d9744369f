// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/mapping/mapped_frames.hpp"
#include "core/segmentation/segmentation.hpp"
#include "eval/cli/shared/choice_flags.hpp"
#include "eval/cli/shared/folder_flags.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Of --poses: groundtruth.txt; else a PoseSource that finds them in the depth images.
constexpr const char* kPosesOfFile = "file";

/// What `mapscore map` is asked for.
struct MapVerbFlags {
  FolderFlags source;
  std::string file, color_file, ply_file;
  std::string study, method, poses{kPosesOfFile};
  /// As the authors' released code has it, where neither a study nor flags say otherwise.
  ChoiceFlags<Segmentation> segmentation{"--segmentation", RegionGrowing{.radius_factor = 0.5}};
  ChoiceFlags<MappedFrames> mapped{"--mapped", AllFrames{}};
  std::vector<std::string> overrides;
  std::optional<double> voxel_m, K, threshold;
  std::vector<double> origin_m{0, 0, 0};
  double yaw_deg = 0.0;
  bool quiet = false;
};

/// How the folder is read and mapped.
void add_mapping_flags(CLI::App& verb, MapVerbFlags& flags);

}  // namespace mapscore::eval
