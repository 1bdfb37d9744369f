// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/map_flags.hpp"

#include "eval/cli/shared/options.hpp"
#include "eval/study/localization_settings.hpp"

#include <set>
#include <utility>

namespace mapscore::eval {

void add_mapping_flags(CLI::App& verb, MapVerbFlags& flags) {
  flags.source.add_to(verb, "--calibration", "are mapped");
  verb.add_option("--poses", flags.poses,
                  "groundtruth.txt (file), or found in the depth images, from the first one's "
                  "camera or base: "
                  "visual_odometry, or visual_slam, which closes loops too [file]")
      ->check(CLI::IsMember({std::string(kPosesOfFile),
                             std::string(word_of(PoseSource::visual_odometry)),
                             std::string(word_of(PoseSource::visual_slam))}))
      ->group(FolderFlags::kGroup);
  flags.segmentation.add_to(verb, "Mapping");
  flags.mapped.add_to(verb, "Mapping");
  const auto add = [&](const char* name, auto& value, const char* text) {
    return verb.add_option(name, value, text)->group("Mapping");
  };
  add("--study", flags.study,
      "Takes voxel size, detected classes, segmentation, place, fusion, occupancy, frames and "
      "refinement of this study, with --poses visual_... its localization.visual, no faults; a "
      "frame is drawn once, at its pose");
  add("--set", flags.overrides, "A key of the study, path=value; may be repeated")
      ->allow_extra_args(false);
  add("--method", flags.method, "Name of its method [the first]");
  add("--voxel_m", flags.voxel_m, "Voxel edge in metres [0.05]")->check(finite_within(1e-3, 10));
  add("--K", flags.K, "Weight of what the map held before, in the blend [0.5]")
      ->check(finite_within(0, 0.999));
  add("--origin_m", flags.origin_m, "Origin of the map in the frame of the poses: x y z [0 0 0]")
      ->expected(3)
      ->check(finite_within(-1e6, 1e6));
  add("--yaw_deg", flags.yaw_deg, "Heading of the map there [0]")->check(finite_within(-360, 360));
  add("--threshold", flags.threshold,
      "Least probability of a voxel in --color and --ply [(1 - K) / 2]")
      ->check(finite_within(0, 1));
}

}  // namespace mapscore::eval
