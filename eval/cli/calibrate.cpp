// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibrator.hpp"
#include "core/error.hpp"
#include "core/segmentation/detection.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/folder_flags.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/foreign/camera_file.hpp"
#include "eval/lab/folder_mapping.hpp"
#include "eval/lab/sights.hpp"
#include "eval/report/calibration_report.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/pictures/outline_picture.hpp"
#include "files/text.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

namespace mapscore::eval {
namespace {

struct CalibrateFlags {
  FolderFlags source;
  std::string file, picture;
  CalibratorSettings settings;
  bool quiet = false;
  int* exit_code = nullptr;
};

/// Frames of a folder of either kind.
struct CalibrationFrames {
  Calibration start;
  double time_offset_s = 0;  ///< that the start believes in
  std::vector<SemanticClass> classes;
  int count = 0;
  std::vector<std::filesystem::path> images;  ///< that are read, and may lie outside of the folder
  std::function<Sight(int)> sight;
  std::function<std::optional<FrameMotion>(int)> motion;
};

CalibrationFrames frames_of_trial(const CalibrateFlags& flags) {
  if (flags.settings.time_offset)
    throw Error(
        "--time_offset: needs to know how the robot moved at each depth image, and a trial's "
        "folder has poses of its frames alone; give a recording");
  const auto folder =
      std::make_shared<const TrialFolder>(flags.source.trial({FolderFlags::kGroup}, {}));
  return {folder->sheet().believed,        0.0, folder->sheet().classes,
          folder->frame_count(),           {},  [folder](int n) { return folder->sight(n); },
          [](int) { return std::nullopt; }};
}

CalibrationFrames frames_of_folder(const CalibrateFlags& flags) {
  const bool timed = flags.settings.time_offset;
  const std::filesystem::path poses =
      std::filesystem::path(flags.source.folder) / "groundtruth.txt";
  if (timed && !std::filesystem::is_regular_file(poses))
    throw Error(fmt::format(
        "--time_offset: needs to know how the robot moved, and {} is missing; leave the flag out",
        shown(poses)));
  const auto folder = std::make_shared<const LabelledFolder>(flags.source.labelled(timed));
  const auto motion = [folder](int n) -> std::optional<FrameMotion> {
    if (const auto velocity = folder->motion(n)) return FrameMotion{*velocity, folder->lag_s(n)};
    return std::nullopt;
  };
  return {folder->calibration(),
          folder->time_offset_s(),
          folder->table().classes,
          folder->frame_count(),
          folder->image_files(),
          [folder](int n) { return sight_of(*folder, n); },
          motion};
}

/// The frame that says most of what is known least.
std::ptrdiff_t most_telling(const CalibrationEstimate& estimate) {
  const auto most = std::ranges::max_element(estimate.frames, {}, &FrameContribution::information);
  return most - estimate.frames.begin();
}

void write_outlines(const CalibrateFlags& flags, const CalibrationFrames& from,
                    const std::map<int, Sight>& sights, const CalibrationEstimate& estimate) {
  const auto& [frame, sight] = *std::next(sights.begin(), most_telling(estimate));
  const char* after =
      estimate.verdict == CalibrationVerdict::calibrated ? "estimate" : "found, not used";
  const cv::Mat3b picture = outline_picture(
      sight, {from.classes, {}},
      {{fmt::format("start, frame {}", frame), from.start},
       {fmt::format("{}, frame {}", after, frame), estimate.correction.applied(from.start)}});
  std::cout << shown(write_picture(flags.picture, picture)) << '\n';
}

bool is_calibration(const std::filesystem::path& file) try {
  return load_yaml(file).has("estimate");
} catch (const Error&) {
  return false;
}

/// Throws Error where an output would take the place of an image of the recording, or of a file
/// that is no earlier output.
void keep_inputs(const CalibrateFlags& flags) {
  namespace fs = std::filesystem;
  std::error_code none;
  const auto refuse = [](const char* flag, const std::string& file, const char* what) {
    throw Error(fmt::format("{}: {} is there and {}; give another name", flag, shown(file), what));
  };
  if (fs::is_regular_file(flags.file) && !is_calibration(flags.file))
    refuse("-o", flags.file, "is no calibration of an earlier run");
  fs::path folder = fs::weakly_canonical(flags.source.folder, none);
  if (!folder.has_filename()) folder = folder.parent_path();  // it was written with a slash
  const fs::path picture = fs::weakly_canonical(flags.picture, none);
  if (!flags.picture.empty() && fs::exists(picture) &&
      std::ranges::mismatch(folder, picture).in1 == folder.end())
    refuse("--picture", flags.picture, "may be an image of the recording");
}

void calibrate(const CalibrateFlags& flags) {
  check_outputs({{"-o", flags.file, ".yaml"}, {"--picture", flags.picture, ".png"}},
                flags.source.inputs());
  keep_inputs(flags);
  const CalibrationFrames from =
      is_trial_folder(flags.source.folder) ? frames_of_trial(flags) : frames_of_folder(flags);
  std::vector<InputFile> images;
  for (const std::filesystem::path& image : from.images) images.push_back({"FOLDER", image});
  check_outputs({{"--picture", flags.picture, ".png"}}, images);
  const std::vector<int> asked = flags.source.chosen_frames(from.count);
  Progress progress("calibrate", "frames", flags.quiet);
  const std::map<int, Sight> sights =
      sights_of_objects(asked, flags.settings.frames, [&, read = 0](int frame) mutable {
        progress.show(++read, std::ssize(asked));
        return from.sight(frame);
      });
  if (sights.empty())
    throw Error(
        fmt::format("{}: of {} frames none has a label image that shows an object; check "
                    "--classes and --detect, or give other frames",
                    shown(flags.source.folder), asked.size()));
  Calibrator calibrator(from.start, flags.settings);
  std::vector<int> chosen;
  bool moves = false;
  for (const auto& [frame, sight] : sights) {
    const std::optional<FrameMotion> motion = from.motion(frame);
    moves = moves || motion;
    chosen.push_back(frame);
    calibrator.add(sight, motion);
  }
  if (flags.settings.time_offset && !moves)
    throw Error(fmt::format(
        "--time_offset: groundtruth.txt of {} has no poses around these frames' stamps, at most "
        "0.25 s apart; leave the flag out, or add poses",
        shown(flags.source.folder)));
  const CalibrationEstimate estimate = calibrator.estimate();
  std::cout << fmt::format("frames that show objects: {} of {}\n", chosen.size(), asked.size())
            << calibration_summary(estimate) << '\n';
  if (!estimate.weakest.empty())
    std::cout << calibration_numbers(estimate) << '\n' << calibration_frames(estimate, chosen);
  const auto together = lock_outputs({flags.file, flags.picture});
  if (!flags.picture.empty()) write_outlines(flags, from, sights, estimate);
  if (!is_known(estimate.verdict)) {
    std::cerr << fmt::format(
        "mapscore: {} is not written: the frames do not tell the calibration{}\n",
        shown(flags.file),
        std::filesystem::exists(flags.file) ? "; the one that is there is of an earlier run" : "");
    *flags.exit_code = 1;
    return;
  }
  const bool is_start = estimate.verdict == CalibrationVerdict::confirmed;
  const BelievedCameras cameras{estimate.calibration,
                                from.time_offset_s + (is_start ? 0.0 : estimate.correction.time_s)};
  write_whole_file(flags.file,
                   fmt::format("# Estimated by `mapscore calibrate`; `mapscore map FOLDER "
                               "--calibration FILE` maps with it.\n{}{}",
                               cameras_file_text(cameras), estimate_yaml(estimate, from.start)));
  std::cout << shown(flags.file) << '\n';
}

/// --frames says which frames; how many of them are used at most is --most_frames.
void add_settings(CLI::App& verb, CalibratorSettings& settings) {
  CalibratorSettings::fields(settings, [&]<class T>(T& member, const Field& field) {
    const std::string key(field.key), meaning(field.meaning);
    const std::string name = key == "frames" ? "--most_frames" : "--" + key;
    if constexpr (std::same_as<T, bool>)
      verb.add_flag(name, member, meaning);
    else if constexpr (std::same_as<T, Degrees>)
      verb.add_option(name, member.deg, fmt::format("{} [{}]", meaning, member.deg))
          ->check(finite_within(field.range.low, field.range.high));
    else
      verb.add_option(name, member, fmt::format("{} [{}]", meaning, member))
          ->check(finite_within(field.range.low, field.range.high));
  });
}

}  // namespace

void add_calibrate(CLI::App& program, int& exit_code) {
  const auto [verb, flags] = add_verb<CalibrateFlags>(
      program, "calibrate", "Find how depth lies to colour, from label images and depth alone",
      calibrate);
  flags->exit_code = &exit_code;
  flags->source.add_to(*verb, "--start", "tell");
  verb->add_option("-o,--output", flags->file,
                   "Calibration to write (.yaml), as `map --calibration` reads it")
      ->required();
  verb->add_option("--picture", flags->picture,
                   "Also a picture (.png) of a frame's outlines and steps of depth, before and "
                   "after");
  add_settings(*verb, flags->settings);
  verb->add_flag("--time_offset", flags->settings.time_offset,
                 "Find the time between the streams too; needs groundtruth.txt and a robot that "
                 "turns");
  verb->add_flag("-q,--quiet", flags->quiet, "No progress on standard error");
  verb->footer(
      "Reads neither truth nor colours. Prints how far the estimate lies from the start, how well\n"
      "it is known, and of each frame: the length of its outlines, the steps of depth near them,\n"
      "the share of the outlines that steps explain, the frame's share of what is known in the\n"
      "direction that is known least, and how far steps lie from outlines, by the estimate and by\n"
      "one without this frame.\n"
      "A start that is right within chance is confirmed and written as it is. Where the frames do\n"
      "not tell, or the start explains them better, no calibration is written, and the exit code\n"
      "is 1 (docs/methods.md, Calibration from a recording).\n"
      "Examples:\n"
      "  mapscore calibrate /data/robot --start cameras.yaml --classes ade.yaml -o "
      "calibration.yaml "
      "--picture outlines.png\n"
      "  mapscore map /data/robot --calibration calibration.yaml --classes ade.yaml -o map.ot\n"
      "  mapscore calibrate /data/robot --frames 0:200:10 --time_offset -o calibration.yaml");
}

}  // namespace mapscore::eval
