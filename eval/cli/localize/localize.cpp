// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/localize/localization_table.hpp"
#include "eval/cli/localize/localize_flags.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/lab/pose_sources.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/localization/localization_score.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/figures/believed_figures.hpp"
#include "eval/report/figures/figures.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "eval/study/study.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScoresFile = "localization_scores.csv";

/// The grid that the filter localises on, or that was given to be drawn. Of all sources the filter
/// is taken out where no grid can be cut for it; `notes` says so.
std::optional<OccupancyGrid> filter_grid(const LocalizeFlags& flags, const Study& study,
                                         const Recording& recording,
                                         std::vector<std::string>& sources, std::string& notes) {
  constexpr std::string_view kFilter = word_of(PoseSource::particle_filter);
  const bool filter = std::ranges::find(sources, kFilter) != sources.end();
  if (!filter && !(study.localization.grid && recording.has_scans())) return {};
  try {
    return grid_of(recording, study);
  } catch (const Error& error) {
    if (flags.source != kAllSources || study.localization.grid) throw;
    notes += left_out(kFilter, error.what());
    std::erase(sources, kFilter);
    return {};
  }
}

/// What a believed trajectory says at each frame, in the format of TUM.
std::string frame_poses_text(const BelievedTrajectory& believed,
                             const std::vector<TrajectoryPose>& truth) {
  std::vector<TrajectoryPose> poses;
  for (const TrajectoryPose& at : truth) {
    const PoseBelief belief = believed.at(at.stamp_s);
    poses.push_back({at.stamp_s, belief.T_map_odom * belief.T_odom_base});
  }
  return trajectory_text(poses);
}

/// How the pose of each depth image came about.
std::string tracking_csv(const VisualTrajectory& visual) {
  std::string text = "stamp_s,tracking,key_frame,closed_loop,known_share,inlier_share\n";
  for (const OdometryStep& step : visual.steps)
    text += fmt::format("{},{},{},{},{:.4f},{:.4f}\n", step.stamp_s, word_of(step.tracking),
                        step.key_frame ? 1 : 0, step.closed_loop ? 1 : 0, step.known_share,
                        step.inlier_share);
  return text;
}

/// Names of all files that `localize` writes, but for what a figure adds to its name.
std::vector<std::string> written_names() {
  std::vector<std::string> names{"localization.txt", "localization.csv", kScoresFile,
                                 "truth_at_frames.txt"};
  for (const char* figure : {"errors_over_time", "trajectory_on_grid", "poses_by_source"})
    for (const char* suffix : {".dat", ".gp", ".png", ".pdf", ".svg"})
      names.push_back(std::string(figure) + suffix);
  for (const std::string& source : localizing_sources())
    for (const char* name : {"localization_{}.txt", "{}_at_frames.txt", "{}_tracking.csv"})
      names.push_back(fmt::format(fmt::runtime(name), source));
  return names;
}

/// Removes what an earlier run left, so that figures and poses of one recording never stand beside
/// scores of another; what this run is to read stays.
void remove_earlier(const fs::path& folder, const Study& study) {
  if (!fs::exists(folder / kScoresFile)) return;
  std::vector<std::string> names = written_names();
  if (!study.localization.grid) names.insert(names.end(), {"grid.yaml", "grid.pgm"});
  int removed = 0;
  for (const std::string& name : names) {
    std::error_code none;  // there is no such trajectory, so it is another file
    const auto& read = study.localization.trajectory;
    if (read && fs::equivalent(resolve_path(study, *read), folder / name, none)) continue;
    removed += fs::remove(folder / name) ? 1 : 0;
  }
  std::cerr << fmt::format("localize: removed {} files of an earlier run from {}\n", removed,
                           shown(folder));
}

/// Names and texts, kept until all is computed: until then an earlier run's files stay.
using FileTexts = std::vector<std::pair<std::string, std::string>>;

/// Of one repetition; says how visual odometry fared.
BelievedTrajectory believed_by(const Recording& recording, const Task& task,
                               const OccupancyGrid* grid, FileTexts& files,
                               const std::function<void(int, int)>& progress) {
  const PoseSource source = task.config.localization.source;
  if (!is_visual(source)) return believed_trajectory(recording, task, grid, progress);
  const VisualTrajectory visual = visual_trajectory(recording, task, progress);
  const std::string name = leaf_text(task.config, "localization.source");
  if (task.seed_index == 0) files.emplace_back(name + "_tracking.csv", tracking_csv(visual));
  std::cerr << fmt::format("{}, seed {}: {}\n", name, task.seed_index,
                           TrackingCounts::of(visual).text());
  if (visual.without_images_s > 0.0 && task.seed_index == 0)
    std::cerr << fmt::format(
        "{}: {:.1f} s lie in gaps of the depth images, where the wheels alone carry\n", name,
        visual.without_images_s);
  return visual.believed;
}

/// Where one source is, in all repetitions; the files hold the poses of the first one.
SourceScores localised(const Study& study, const Recording& recording, const OccupancyGrid* grid,
                       const LocalizeFlags& flags, const std::vector<TrajectoryPose>& truth,
                       FileTexts& files) {
  const std::string name = leaf_text(study, "localization.source");
  Progress progress("localize", is_visual(study.localization.source) ? "depth images" : "turns",
                    flags.quiet);
  SourceScores scores{name, {}};
  std::string first;
  for (int run = 0; run < study.seeds; ++run) {
    Task task;
    task.config = study;
    task.seed_index = run;
    const BelievedTrajectory believed =
        believed_by(recording, task, grid, files, [&](int done, int total) {
          progress.show(std::int64_t{run} * total + done, std::int64_t{study.seeds} * total);
        });
    if (run == 1 && believed_text(believed) == first) {
      std::cerr << fmt::format(
          "localize: {}: draws nothing at random here, so all {} repetitions are the same\n", name,
          study.seeds);
      scores.seeds.resize(static_cast<std::size_t>(study.seeds), scores.seeds.front());
      break;
    }
    if (run == 0) {
      first = believed_text(believed);
      files.emplace_back(flags.source == kAllSources ? fmt::format("localization_{}.txt", name)
                                                     : "localization.txt",
                         first);
      files.emplace_back(name + "_at_frames.txt", frame_poses_text(believed, truth));
    }
    scores.seeds.push_back(score_localization(believed, truth));
  }
  return scores;
}

/// Of all sources, one after the other, and the files of their errors.
std::vector<SourceScores> all_localised(Study study, const Recording& recording,
                                        const std::vector<std::string>& sources,
                                        const OccupancyGrid* grid, const LocalizeFlags& flags,
                                        FileTexts& files) {
  const std::vector<TrajectoryPose> truth = true_poses(recording);
  files.emplace_back("truth_at_frames.txt", trajectory_text(truth));
  std::vector<SourceScores> scores;
  for (const std::string& source : sources) {
    set_leaf(study, "localization.source", source);
    scores.push_back(localised(study, recording, grid, flags, truth, files));
  }
  files.emplace_back("localization.csv", frame_errors_csv(scores));
  files.emplace_back(kScoresFile, scores_csv(scores));
  return scores;
}

/// The wheels stand beside any other source.
std::vector<std::string> drawn_sources(const LocalizeFlags& flags, const Recording& recording,
                                       std::vector<std::string> sources) {
  constexpr std::string_view kWheels = word_of(PoseSource::odometry);
  if (flags.source != kAllSources && flags.source != kWheels && recording.has_odometry())
    sources.emplace_back(kWheels);
  return sources;
}

void list_files(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) std::cout << shown(file) << '\n';
}

void localize(const LocalizeFlags& flags) {
  const FigureStyle style = flags.style.style();
  const Recording recording = Recording::open(flags.recording);
  Study study = study_of(flags);
  std::string notes;
  std::vector<std::string> sources = chosen_sources(flags, study, recording, notes);
  const std::optional<OccupancyGrid> grid = filter_grid(flags, study, recording, sources, notes);
  const std::vector<std::string> drawn = drawn_sources(flags, recording, sources);
  if (!sources.empty()) refuse_without_effect(flags, study, recording, drawn);
  std::cerr << notes;
  if (sources.empty())
    throw Error(
        fmt::format("{}: no source has anything to go by; record it with trajectory.drive: "
                    "{{wheels: {{}}}}, give a trajectory, or go by its depth images: --set "
                    "localization.visual.wheels=false",
                    shown(recording.folder())));
  const fs::path folder = flags.output;
  const FolderLock lock(folder);
  fs::create_directories(folder);
  FileTexts files;
  const std::vector<SourceScores> scores =
      all_localised(study, recording, sources, grid ? &*grid : nullptr, flags, files);
  remove_earlier(folder, study);
  if (grid) save_grid(*grid, folder / "grid.yaml");
  for (const auto& [name, text] : files) write_whole_file(folder / name, text);
  const StudySummary summary = pose_summary(study, scores);
  study.sweep = {{"localization.source", drawn}};
  const Pictures pictures = draw_believed(study, recording, {}, folder, style);
  list_files(pictures.files);
  if (!pictures.skipped.empty())
    std::cerr << fmt::format("localize: no trajectory_on_grid: {}\n", shown(pictures.skipped));
  if (flags.source == kAllSources) list_files(draw(pose_figure(summary, style).value(), folder));
  std::cout << converged_rows(scores) << '\n' << to_text(trajectory_scores_table(summary));
}

}  // namespace

void add_localize(CLI::App& program) {
  const auto [verb, flags] = add_verb<LocalizeFlags>(
      program, "localize", "Localise the robot anew from a recording's logs", localize);
  verb->add_option(
          "RECORDING", flags->recording,
          "Folder with odometry.txt for the wheels, depth images for visual odometry and SLAM, "
          "and scan/scans.bin for the filter")
      ->required();
  verb->add_option("-o,--output", flags->output, "Folder for the results")->required();
  flags->add_to(*verb);
  verb->footer(
      "Writes grid.yaml and .pgm of the filter; of the first seed localization.txt, the poses at "
      "the "
      "frames\n"
      "(truth_at_frames.txt, SOURCE_at_frames.txt: TUM), trajectory_on_grid and errors_over_time "
      "(.png, .pdf, .svg); of all\n"
      "seeds localization.csv (errors by frame) and localization_scores.csv (ATE, RPE, NEES); "
      "with --source all\n"
      "localization_SOURCE.txt and poses_by_source (.png, .pdf, .svg); with visual odometry "
      "SOURCE_tracking.csv (how\n"
      "each depth image was placed; counted on standard error). Prints the errors after "
      "convergence, then\n"
      "ATE, RPE and NEES of all frames (docs/metrics.md). What an earlier run left of these files "
      "is removed.\n"
      "Examples:\n"
      "  mapscore localize results/home/recordings/home-* -o results/home/localized --seeds 10\n"
      "  mapscore localize /data/home -o out --global --grid /data/home/map.yaml\n"
      "  mapscore localize /data/home -o out --source all --seeds 5\n"
      "  mapscore localize /data/home -o out --source visual_slam "
      "--set faults.depth.preset=astra\n"
      "  mapscore localize /data/home -o out --source trajectory "
      "--set localization.trajectory=slam.txt\n"
      "  mapscore localize /data/home -o out --set localization.grid_resolution_m=0.05 "
      "--set localization.filter.temper=0.2");
}

}  // namespace mapscore::eval
