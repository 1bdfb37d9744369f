// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/localization_picture.hpp"
#include "eval/cli/options.hpp"
#include "eval/cli/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/localization/believed_file.hpp"
#include "eval/localization/filter_run.hpp"
#include "eval/localization/localization_score.hpp"
#include "eval/localization/odometry_run.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/whole_file.hpp"
#include "eval/truth/floor_grid.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

struct LocalizeFlags {
  std::string recording, output, source = "particle_filter", model = "likelihood_field";
  std::optional<std::string> grid;
  bool global_start = false;
  int seeds = 1;
  std::uint64_t seed = 0;
  double resolution_m = FloorGridOptions{}.resolution_m;
  WorkFlags work;
};

/// What a recording says of its drive.
struct DriveLogs {
  std::vector<OdometryPose> odometry;
  ScanLog scans;
  std::vector<TrajectoryPose> frames;  ///< true pose at each colour image
  Pose T_map_base_start = Pose::Identity();
};

DriveLogs read_logs(const Recording& recording) {
  DriveLogs logs{recording.read_odometry(), recording.read_scans(), {}, Pose::Identity()};
  for (int n = 0; n < recording.frame_count(); ++n)
    logs.frames.push_back({recording.color_stamp_s(n), recording.T_world_base_of_color(n)});
  const fs::path truth = recording.folder() / "groundtruth.txt";
  const double start_s = logs.odometry.front().stamp_s;
  const auto start = interpolated(read_trajectory(truth), start_s);
  if (!start)
    throw Error(fmt::format("{}: has no pose at {} s, where odometry.txt starts; lengthen it",
                            truth.string(), start_s));
  logs.T_map_base_start = *start;
  return logs;
}

OccupancyGrid grid_for(const LocalizeFlags& flags, const Recording& recording,
                       const DriveLogs& logs) {
  if (flags.grid) {
    OccupancyGrid grid = load_grid(*flags.grid);
    check_start(grid, planar(logs.T_map_base_start), *flags.grid);
    return grid;
  }
  if (!recording.info().has_truth)
    throw Error(fmt::format("{}: has no truth to cut a grid from; give one by --grid",
                            recording.folder().string()));
  FloorGridOptions options;
  options.height_m = logs.scans.geometry.T_base_lidar.translation().z();
  options.resolution_m = flags.resolution_m;
  options.start_m = logs.T_map_base_start.translation().head<2>();
  options.jobs = flags.work.jobs;
  return floor_grid(recording.read_shapes(), Pose::Identity(), options);
}

BelievedTrajectory localised(const LocalizeFlags& flags, const DriveLogs& logs,
                             const OccupancyGrid& grid, std::uint64_t seed, Progress& progress,
                             int run) {
  FilterSettings settings;
  settings.global_start = flags.global_start;
  settings.filter.jobs = flags.work.jobs;
  if (flags.model == "beam") settings.model = BeamModelParams{};
  const PlanarPose start = planar(logs.T_map_base_start);
  if (flags.source == "odometry") return odometry_only(logs.odometry, start, settings.filter.noise);
  return run_filter(
      logs.odometry, logs.scans, grid, settings, start, seed, [&](int done, int total) {
        progress.show(std::int64_t{run} * total + done, std::int64_t{flags.seeds} * total);
      });
}

std::string csv_of(std::uint64_t seed, const LocalizationScore& score) {
  std::string text;
  for (const FrameError& frame : score.frames)
    text += fmt::format("{},{},{:.6f},{:.5f},{:.5g},{:.6f},{}\n", seed, frame.stamp_s,
                        frame.position_m, frame.heading_rad * 180.0 / std::numbers::pi, frame.nees,
                        frame.sigma_m, frame.converged ? 1 : 0);
  return text;
}

void print_row(const std::string& source, std::uint64_t seed, const LocalizationScore& score) {
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

void localize(const LocalizeFlags& flags) {
  const Recording recording = Recording::open(flags.recording);
  const DriveLogs logs = read_logs(recording);
  const OccupancyGrid grid = grid_for(flags, recording, logs);
  const fs::path folder = flags.output;
  fs::create_directories(folder);
  save_grid(grid, folder / "grid.yaml");
  std::string csv = "seed,stamp_s,position_error_m,heading_error_deg,nees,sigma_m,converged\n";
  std::vector<LocalizationScore> scores;
  {
    Progress progress("localize", "scans", flags.work.quiet);
    for (int run = 0; run < flags.seeds; ++run) {
      const std::uint64_t seed = flags.seed + static_cast<std::uint64_t>(run);
      const BelievedTrajectory believed = localised(flags, logs, grid, seed, progress, run);
      if (run == 0) {
        write_whole_file(folder / "localization.txt", believed_text(believed));
        draw_localization(grid, believed, logs.frames, flags.source, folder);
      }
      scores.push_back(score_localization(believed, logs.frames));
      csv += csv_of(seed, scores.back());
    }
  }
  write_whole_file(folder / "localization.csv", csv);
  std::cout << fmt::format("{:<16} {:>5} {:>11} {:>9} {:>9} {:>10} {:>10} {:>10}\n", "source",
                           "seed", "converged_s", "mean_m", "p95_m", "mean_deg", "p95_deg",
                           "nees_share");
  for (std::size_t run = 0; run < scores.size(); ++run)
    print_row(flags.source, flags.seed + run, scores[run]);
}

}  // namespace

void add_localize(CLI::App& program) {
  auto* verb =
      program.add_subcommand("localize", "Localise the robot anew from a recording's logs");
  const auto flags = std::make_shared<LocalizeFlags>();
  verb->add_option("RECORDING", flags->recording, "Folder with odometry.txt and scan/scans.bin")
      ->required();
  verb->add_option("-o,--output", flags->output, "Folder for the results")->required();
  verb->add_option("--source", flags->source, "particle_filter or odometry")
      ->check(CLI::IsMember({"particle_filter", "odometry"}))
      ->capture_default_str();
  verb->add_option("--model", flags->model, "Of a scan: likelihood_field or beam")
      ->check(CLI::IsMember({"likelihood_field", "beam"}))
      ->capture_default_str();
  verb->add_flag("--global", flags->global_start, "Start anywhere, not near the true start");
  verb->add_option("--grid", flags->grid,
                   "YAML of a ROS map_server grid in the scene's world; default: cut from the "
                   "truth at the lidar's height");
  verb->add_option("--resolution_m", flags->resolution_m, "Cell of the grid that is cut")
      ->check(finite_within(0.005, 1.0))
      ->capture_default_str();
  verb->add_option("--seeds", flags->seeds, "Runs, each with noise and draws of its own")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb->add_option("--seed", flags->seed, "Of the first run")->capture_default_str();
  flags->work.add_to(*verb);
  verb->footer(
      "Writes grid.yaml and .pgm, localization.txt and trajectory.png and .pdf (first seed), and\n"
      "localization.csv (errors by frame, all seeds); prints the errors after convergence\n"
      "(docs/metrics.md).\n"
      "Examples:\n"
      "  mapscore localize results/home/recordings/home-* -o results/home/localized --seeds 10\n"
      "  mapscore localize /data/home -o out --global --grid /data/home/map.yaml\n"
      "  mapscore localize /data/home -o out --source odometry");
  verb->callback([flags] { localize(*flags); });
}

}  // namespace mapscore::eval
