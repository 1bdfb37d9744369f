// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/whole_file.hpp"
#include "eval/cli/shared/figure_flags.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/localization/localization_score.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/figures/believed_figures.hpp"
#include "eval/study/study.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct LocalizeFlags {
  std::string recording, output, source = "particle_filter", model = "likelihood_field";
  std::optional<std::string> grid;
  bool global_start = false;
  int seeds = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> overrides;
  bool quiet = false;
  FigureFlags style;
};

/// A study of nothing but the localisation, with a lidar as one buys it.
Study study_of(const LocalizeFlags& flags) {
  Study study;
  study.name =
      shown((fs::absolute(flags.recording) / "").lexically_normal().parent_path().filename());
  study.recording = flags.recording;
  study.methods = {{"direct", Direct{}}};  // a study has one; nothing is mapped here
  study.seed = flags.seed;
  study.seeds = flags.seeds;
  set_leaf(study, "localization.source", flags.source);
  set_leaf(study, "localization.filter.scan_model", flags.model);
  set_leaf(study, "faults.lidar.preset", "rplidar_a2");
  if (flags.global_start) set_leaf(study, "localization.filter.start", "global");
  study.localization.grid = flags.grid;
  set_leaves(study, flags.overrides);
  check(study);
  return study;
}

std::string csv_of(int seed, const LocalizationScore& score) {
  std::string text;
  for (const FrameError& frame : score.frames)
    text += fmt::format("{},{},{:.6f},{:.5f},{},{:.6f},{}\n", seed, frame.stamp_s, frame.position_m,
                        frame.heading_rad * 180.0 / std::numbers::pi,
                        frame.nees ? fmt::format("{:.5g}", *frame.nees) : "", frame.sigma_m,
                        frame.converged ? 1 : 0);
  return text;
}

void print_row(const std::string& source, int seed, const LocalizationScore& score) {
  if (!score.converged_s) {
    std::cout << fmt::format("{:<16} {:>5} {:>11}\n", source, seed, "never");
    return;
  }
  const std::string share = score.nees_share ? fmt::format("{:.3f}", *score.nees_share) : "-";
  std::cout << fmt::format("{:<16} {:>5} {:>11.2f} {:>9.4f} {:>9.4f} {:>10.3f} {:>10.3f} {:>10}\n",
                           source, seed, *score.converged_s, score.position_m.mean,
                           score.position_m.p95, score.heading_deg.mean, score.heading_deg.p95,
                           share);
}

/// Scores of all repetitions; the files of the first one.
std::vector<LocalizationScore> localised(const Study& study, const Recording& recording,
                                         const OccupancyGrid& grid, bool quiet,
                                         const fs::path& folder) {
  Progress progress("localize", "turns", quiet);
  std::vector<LocalizationScore> scores;
  for (int run = 0; run < study.seeds; ++run) {
    Task task;
    task.config = study;
    task.seed_index = run;
    const BelievedTrajectory believed =
        believed_trajectory(recording, task, &grid, [&](int done, int total) {
          progress.show(std::int64_t{run} * total + done, std::int64_t{study.seeds} * total);
        });
    if (run == 0) write_whole_file(folder / "localization.txt", believed_text(believed));
    scores.push_back(score_localization(believed, recording));
  }
  return scores;
}

void localize(const LocalizeFlags& flags) {
  const FigureStyle style = flags.style.style();
  Study study = study_of(flags);
  const Recording recording = Recording::open(flags.recording);
  const OccupancyGrid grid = grid_of(recording, study);
  const fs::path folder = flags.output;
  const FolderLock lock(folder);
  fs::create_directories(folder);
  save_grid(grid, folder / "grid.yaml");
  const std::vector<LocalizationScore> scores =
      localised(study, recording, grid, flags.quiet, folder);
  std::string csv = "seed,stamp_s,position_error_m,heading_error_deg,nees,sigma_m,converged\n";
  for (int run = 0; const LocalizationScore& score : scores) csv += csv_of(run++, score);
  write_whole_file(folder / "localization.csv", csv);
  if (flags.source != "odometry")
    study.sweep = {{"localization.source", {flags.source, "odometry"}}};
  for (const fs::path& file : draw_believed(study, recording, {}, folder, style))
    std::cout << shown(file) << '\n';
  std::cout << fmt::format("{:<16} {:>5} {:>11} {:>9} {:>9} {:>10} {:>10} {:>10}\n", "source",
                           "seed", "converged_s", "mean_m", "p95_m", "mean_deg", "p95_deg",
                           "nees_share");
  for (int run = 0; const LocalizationScore& score : scores) print_row(flags.source, run++, score);
}

}  // namespace

void add_localize(CLI::App& program) {
  const auto [verb, flags] = add_verb<LocalizeFlags>(
      program, "localize", "Localise the robot anew from a recording's logs", localize);
  verb->add_option("RECORDING", flags->recording, "Folder with odometry.txt and scan/scans.bin")
      ->required();
  verb->add_option("-o,--output", flags->output, "Folder for the results")->required();
  verb->add_option("--source", flags->source,
                   "particle_filter, odometry, visual_odometry or visual_slam")
      ->check(CLI::IsMember({"particle_filter", "odometry", "visual_odometry", "visual_slam"}))
      ->capture_default_str();
  verb->add_option("--model", flags->model, "Of a scan: likelihood_field or beam")
      ->check(CLI::IsMember({"likelihood_field", "beam"}))
      ->capture_default_str();
  verb->add_flag("--global", flags->global_start, "Start anywhere, not near the true start");
  verb->add_option("--grid", flags->grid,
                   "YAML of a ROS map_server grid in the scene's world; default: cut from the "
                   "truth at the lidar's height");
  verb->add_option("--seeds", flags->seeds,
                   "Repetitions, each with noise and draws of its own: those of a study")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option("--seed", flags->seed, "Of all draws, as a study's `seed`")
      ->capture_default_str();
  verb->add_option("--set", flags->overrides,
                   "A key localization.* or faults.lidar.* of a study; may be repeated")
      ->allow_extra_args(false);
  verb->add_flag("-q,--quiet", flags->quiet, "No progress");
  flags->style.add_to(*verb);
  verb->footer(
      "Writes grid.yaml and .pgm, localization.txt and trajectory_on_grid.png, .pdf and .svg "
      "(first seed), and\n"
      "localization.csv (errors by frame, all seeds); prints the errors after convergence\n"
      "(docs/metrics.md).\n"
      "Examples:\n"
      "  mapscore localize results/home/recordings/home-* -o results/home/localized --seeds 10\n"
      "  mapscore localize /data/home -o out --global --grid /data/home/map.yaml\n"
      "  mapscore localize /data/home -o out --source odometry\n"
      "  mapscore localize /data/home -o out --set localization.grid_resolution_m=0.05 "
      "--set localization.filter.temper=0.2");
}

}  // namespace mapscore::eval
