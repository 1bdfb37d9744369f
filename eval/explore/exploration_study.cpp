// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/exploration_study.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "eval/explore/exploration_scene.hpp"
#include "files/text.hpp"
#include "files/whole_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

std::string folder_word(const std::string& text) {
  std::string word;
  for (const char letter : text)
    word += std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.' ? letter : '_';
  return word;
}

/// scene-planner-method-seed0, of what varies in the study.
std::string name_of(const Study& study, const TrialSpec& spec) {
  std::string name = scene_of(study, spec.cell);
  const auto add = [&](const std::string& part) {
    name += (name.empty() ? "" : "-") + folder_word(part);
  };
  for (const auto& [path, value] : doses_of_scene(study, spec.cell.doses)) add(value);
  if (study.methods.size() > 1) add(spec.method);
  add(fmt::format("seed{}", spec.seed_index));
  return name;
}

void check_explorable(const Study& config) {
  const auto refuse = [](const std::string& path, const std::string& problem) {
    throw Error(path + ": " + problem);
  };
  if (config.recording)
    refuse("recording", "is replayed, and exploring makes one; leave it out, and name the scene");
  if (std::holds_alternative<NoExploration>(config.exploration.planner))
    refuse("exploration.planner",
           "is none: nobody chooses the way; write exploration: {planner: next_best_view}, or "
           "--set exploration.planner=next_best_view");
  if (!config.occupancy.carve)
    refuse("occupancy.carve", "is false, and a planner needs free space; write true");
  if (config.motion) refuse("motion", "moves the scene, and exploring takes it as it stands");
  if (config.faults.time_offset_ms != 0.0)
    refuse("faults.time_offset_ms",
           "pairs images of a recording, and there is none yet; explore without it, and replay the "
           "recording with it");
  if (depth_rate(config) != config.trajectory.frames_per_s)
    refuse("trajectory.depth_frames_per_s",
           "differs from frames_per_s; an exploration maps pairs of one instant, leave it out");
  const PoseSource source = config.localization.source;
  if (source != PoseSource::truth && source != PoseSource::gaussian &&
      source != PoseSource::odometry)
    refuse("localization.source",
           fmt::format("{} is computed from a whole recording, and there is none yet; explore with "
                       "gaussian, truth or odometry, and replay what it recorded",
                       word_of(source)));
  if (config.trajectory.max_frames != 0)
    refuse("trajectory.max_frames",
           "ends a drive along waypoints, and an exploration ends by exploration.budget_m and "
           "budget_s; leave it out");
  if (config.score.unit == ScoreUnit::frame)
    refuse("score.unit", "is frame, and an exploration scores its map; write map");
  if (config.methods.front().command)
    refuse("methods." + config.methods.front().name,
           "is a command, which maps a recording when it is there; explore with a method of ours");
}

class AllExplorations {
 public:
  AllExplorations(const std::vector<PlannedExploration>& planned, const ExploreOptions& options,
                  const ExploreProgress& progress)
      : planned_(planned), options_(options), progress_(progress), scenes_(options.folder) {}

  std::vector<FinishedExploration> run() {
    std::vector<std::optional<KeptExploration>> kept(planned_.size());
    for_each_in_parallel(planned_.size(), options_.jobs, [&](std::size_t n) {
      kept[n] = kept_or_run(n);
      progress_(n, kept[n]->curve.back(), true);
    });
    std::vector<FinishedExploration> finished;
    for (std::size_t n = 0; n < planned_.size(); ++n)
      finished.push_back({planned_[n], std::move(kept[n].value()), folder_of(n)});
    return finished;
  }

 private:
  fs::path folder_of(std::size_t n) const { return options_.folder / "runs" / planned_[n].name; }

  KeptExploration kept_or_run(std::size_t n) {
    const fs::path folder = folder_of(n);
    const ExplorationScenes::Ready ready = scenes_.ready(planned_[n], options_.keep_recordings);
    if (const auto key = key_of_exploration(folder)) {
      if (*key == ready.key) return read_exploration(folder).value();
      refuse_other(folder, *key, ready);
    }
    WholeFolder whole(folder);
    scenes_.run(planned_[n], ready, whole.partial(),
                [&](const CoveragePoint& point) { progress_(n, point, false); });
    whole.finish();
    return read_exploration(folder).value();
  }

  [[noreturn]] static void refuse_other(const fs::path& folder, const std::string& key,
                                        const ExplorationScenes::Ready& ready) {
    if (key == ready.key_of_other)
      throw Error(fmt::format(
          "{}: holds this exploration {}; {} --scores_only, remove the folder, or give another -o",
          shown(folder), ready.records ? "without its recording" : "with its recording",
          ready.records ? "give" : "leave out"));
    throw Error(fmt::format(
        "{}: holds an exploration of another study, scene or build; remove it, or give another -o",
        shown(folder)));
  }

  const std::vector<PlannedExploration>& planned_;
  const ExploreOptions& options_;
  const ExploreProgress& progress_;
  ExplorationScenes scenes_;
};

}  // namespace

std::vector<PlannedExploration> explorations(const Study& study) {
  std::vector<PlannedExploration> planned;
  std::set<std::string> names;
  for (const TrialSpec& spec : trials(study)) {
    Study config = with_method(resolve(study, spec.cell), spec.method);
    check_explorable(config);
    std::string name = name_of(study, spec);
    if (!names.insert(name).second) name += fmt::format("-{}", spec.index);
    planned.push_back({spec, std::move(name), std::move(config)});
  }
  return planned;
}

std::vector<FinishedExploration> explore_all(const std::vector<PlannedExploration>& planned,
                                             const ExploreOptions& options,
                                             const ExploreProgress& progress) {
  return AllExplorations(planned, options, progress).run();
}

}  // namespace mapscore::eval
