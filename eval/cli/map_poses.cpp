// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/map_poses.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <string>

namespace mapscore::eval {
namespace {

/// The keys of a study that decide how a folder is mapped; perception is refused by itself.
constexpr auto kMappedKeys = std::to_array<std::string_view>(
    {"voxel_m", "place", "detect", "methods", "fusion", "occupancy", "perception"});

/// How poses are found in depth images: as a study says, if there is one.
LocalizationSettings pose_settings(const std::optional<Study>& study, const MapVerbFlags& flags) {
  LocalizationSettings settings = study ? study->localization : LocalizationSettings{};
  settings.source = flags.poses == word_of(PoseSource::visual_slam) ? PoseSource::visual_slam
                                                                    : PoseSource::visual_odometry;
  settings.visual.visual = {.wheels = false, .corrected = true};
  return settings;
}

}  // namespace

void check_keys(Study study, const MapVerbFlags& flags) {
  study.localization = pose_settings(study, flags);
  for (const std::string& change : flags.overrides) {
    const std::string path = whole_path(study, change.substr(0, change.find('=')));
    const bool own_words = path.ends_with("wheels") || path.ends_with("corrected");
    if (std::ranges::find(kMappedKeys, path.substr(0, path.find('.'))) != kMappedKeys.end())
      continue;
    if (path.starts_with("localization.") && !own_words && flags.poses != kPosesOfFile &&
        decides_poses(study, path))
      continue;
    throw Error(fmt::format(
        "--set {}: has no effect, `map` adds no faults, has no wheels and scores nothing; leave it "
        "out (keys of {} count, and with --poses visual_odometry or visual_slam those of "
        "localization.visual)",
        change, fmt::join(kMappedKeys, ", ")));
  }
}

FolderPoses found_poses(const MapVerbFlags& flags, const std::optional<Study>& study,
                        LabelledFolder& folder) {
  if (std::filesystem::exists(std::filesystem::path(flags.source.folder) / "groundtruth.txt"))
    std::cerr << fmt::format(
        "mapscore: note: --poses {} finds the poses in the depth images; those of groundtruth.txt "
        "are not used\n",
        flags.poses);
  if (const std::string odd = odd_stamps(folder.depth_images()); !odd.empty())
    std::cerr << fmt::format("mapscore: warning: {}\n", odd);
  Progress progress("map", "poses", flags.quiet);
  FolderPoses found = find_poses(folder, visual_of(pose_settings(study, flags)),
                                 [&](int done, int all) { progress.show(done, all); });
  folder.place(found.trajectory);
  if (found.tracking.untracked() > 0)
    std::cerr << fmt::format(
        "mapscore: warning: of {} depth images the pose is a guess, the first at {} s; what was "
        "mapped from there on may lie beside the rest\n",
        found.tracking.untracked(), found.first_untracked_s.value_or(0.0));
  return found;
}

}  // namespace mapscore::eval
