// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/map_flags.hpp"

#include "eval/cli/shared/options.hpp"
#include "eval/study/localization_settings.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr auto kMasks = names_of(ClassMasks{});

}  // namespace

ClassMasks masks_of(const MapVerbFlags& flags) {
  return static_cast<ClassMasks>(std::ranges::find(kMasks, flags.masks) - kMasks.begin());
}

void add_reading_flags(CLI::App& verb, MapVerbFlags& flags) {
  LabelledFolderOptions& reading = flags.reading;
  const auto add = [&](const char* name, auto& value, const char* text) {
    return verb.add_option(name, value, text)->group("Reading the folder");
  };
  add("--intrinsics", reading.cameras,
      "fx,fy,cx,cy in pixels, or a YAML file; needed without recording.yaml");
  add("--classes", reading.classes,
      "YAML file: what the pixels of label images mean; needed without recording.yaml");
  add("--masks", flags.masks,
      "Class labels become a detection for each connected component, one a class, or, where pixels "
      "are 256 class + instance, one a value: components, classes, instances [components]")
      ->check(CLI::IsMember(std::set<std::string>(kMasks.begin(), kMasks.end())));
  add("--detect", flags.detect, "Classes that are mapped, by commas, or all [as the table says]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add("--depth_scale", reading.depth_units_per_m, "Depth image's units in a metre [5000]")
      ->check(finite_within(1, 1e6));
  add("--range_m", flags.range_m, "Least and most depth that counts: near far [the cameras']")
      ->expected(2)
      ->check(finite_within(0, 100));
  add("--max_offset_s", reading.max_offset_s,
      "Images and poses whose stamps are farther apart do not belong together [0.02]")
      ->check(finite_within(1e-6, 10));
  add("--poses", flags.poses,
      "groundtruth.txt (file), or found in the depth images, from the first one's camera or base: "
      "visual_odometry, or visual_slam, which closes loops too [file]")
      ->check(CLI::IsMember({std::string(kPosesOfFile),
                             std::string(word_of(PoseSource::visual_odometry)),
                             std::string(word_of(PoseSource::visual_slam))}));
  add("--frames", flags.frames, "Of the frames: 3,7,9 or first:end:step, from 0 [all]");
  verb.add_flag("--follow", reading.follow,
                "Images may lie outside of FOLDER: links and paths in its lists are followed")
      ->group("Reading the folder");
}

void add_mapping_flags(CLI::App& verb, MapVerbFlags& flags) {
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
