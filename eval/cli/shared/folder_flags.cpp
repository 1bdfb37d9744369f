// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/folder_flags.hpp"

#include "core/error.hpp"
#include "eval/foreign/camera_file.hpp"
#include "eval/recording/frame_selection.hpp"
#include "eval/results/study_store.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr auto kMasks = names_of(ClassMasks{});

}  // namespace

void FolderFlags::add_to(CLI::App& to, const std::string& cameras, const std::string& use) {
  verb = &to;
  cameras_flag = cameras;
  to.add_option("FOLDER", folder,
                "Folder with depth.txt, groundtruth.txt, color.txt or rgb.txt, and label/ or "
                "label.txt; or one of `mapscore trial`")
      ->required();
  const auto add = [&](const std::string& name, auto& value, const std::string& text) {
    return to.add_option(name, value, text)->group(kGroup);
  };
  add("--intrinsics," + cameras, reading.cameras,
      "fx,fy,cx,cy in pixels, or a YAML file, as `calibrate` writes it; what it leaves out is "
      "recording.yaml's; needed without that file");
  add("--classes", reading.classes,
      "YAML file: what the pixels of label images mean; needed without recording.yaml");
  add("--masks", masks,
      "Class labels become a detection for each connected component, one a class, or, where pixels "
      "are 256 class + instance, one a value: components, classes, instances [components]")
      ->check(CLI::IsMember(std::set<std::string>(kMasks.begin(), kMasks.end())));
  add("--detect", detect, "Classes that " + use + ", by commas, or all [as the table says]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add("--depth_scale", reading.depth_units_per_m, "Depth image's units in a metre [5000]")
      ->check(finite_within(1, 1e6));
  add("--range_m", range_m, "Least and most depth that counts: near far [the cameras']")
      ->expected(2)
      ->check(finite_within(0, 100));
  add("--max_offset_s", reading.max_offset_s,
      "Images and poses whose stamps are farther apart do not belong together [0.02]")
      ->check(finite_within(1e-6, 10));
  add("--frames", frames, "Of the frames: 3,7,9 or first:end:step, from 0 [all]");
  to.add_flag("--follow", reading.follow,
              "Images may lie outside of FOLDER: links and paths in its lists are followed")
      ->group(kGroup);
}

std::vector<InputFile> FolderFlags::inputs() const {
  std::vector<InputFile> files{{cameras_flag, reading.cameras}, {"--classes", reading.classes}};
  for (const char* name : {"recording.yaml", "groundtruth.txt", "depth.txt", "label.txt",
                           "color.txt", "rgb.txt", "trial.yaml", "method.yaml"})
    files.push_back({"FOLDER", std::filesystem::path(folder) / name});
  return files;
}

LabelledFolder FolderFlags::labelled(bool poses) const {
  LabelledFolderOptions options = reading;
  options.masks = static_cast<ClassMasks>(std::ranges::find(kMasks, masks) - kMasks.begin());
  if (!range_m.empty()) options.range_m = std::pair(range_m.at(0), range_m.at(1));
  options.poses = poses;
  LabelledFolder read(folder, options);
  if (!detect.empty()) read.detect_as(detected_table(detect, read.table()).classes);
  return read;
}

TrialFolder FolderFlags::trial(const std::vector<std::string>& groups,
                               std::vector<std::string> allowed) const {
  allowed.insert(allowed.end(), {"--frames", "--intrinsics"});
  for (const CLI::Option* option : verb->get_options())
    if (option->count() > 0 && std::ranges::find(groups, option->get_group()) != groups.end() &&
        std::ranges::find(allowed, option->get_name()) == allowed.end())
      throw Error(fmt::format(
          "{}: has no effect on {}, which is a trial's folder and says itself how it is read and "
          "mapped (trial.yaml, method.yaml); leave it out",
          option->get_name(), shown(folder)));
  TrialFolder read(folder);
  if (reading.cameras.empty()) return read;
  const BelievedCameras cameras = read_cameras(reading.cameras, read.sheet().believed);
  if (cameras.time_offset_s != 0.0)
    throw Error(fmt::format(
        "{}: time_offset_s has no effect on {}, a trial's folder, whose images are paired already; "
        "remove the key",
        shown(reading.cameras), shown(folder)));
  read.believe(cameras.calibration);
  return read;
}

std::vector<int> FolderFlags::chosen_frames(int count) const {
  return (frames.empty() ? FrameSelection() : FrameSelection(frames)).of(count);
}

}  // namespace mapscore::eval
