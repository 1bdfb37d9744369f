// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/localize/localize_flags.hpp"

#include "core/error.hpp"
#include "files/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

bool localises(PoseSource source) {
  return source != PoseSource::gaussian && source != PoseSource::truth;
}

/// Why a recording, or what was given with it, has nothing for a source; empty where it has.
std::string missing_for(const std::string& source, const Study& study, const Recording& recording) {
  if (source == word_of(PoseSource::trajectory))
    return study.localization.trajectory ? "" : "no --set localization.trajectory=FILE";
  const bool visual = source.starts_with("visual");
  if (!recording.has_odometry() && !(visual && !study.localization.visual.visual.wheels))
    return fmt::format("no odometry.txt{}",
                       visual ? "; --set localization.visual.wheels=false goes without" : "");
  if (source == word_of(PoseSource::particle_filter) && !recording.has_scans())
    return "no scan/scans.bin";
  return "";
}

/// What was asked for, as the user wrote it, and the leaf that it sets.
std::vector<std::pair<std::string, std::string>> asked_leaves(const LocalizeFlags& flags,
                                                              const Study& study) {
  std::vector<std::pair<std::string, std::string>> asked;
  if (flags.model) asked.emplace_back("--model", "localization.filter.scan_model");
  if (flags.global_start) asked.emplace_back("--global", "localization.filter.start");
  if (flags.grid) asked.emplace_back("--grid", "localization.grid");
  for (const std::string& change : flags.overrides)
    asked.emplace_back("--set " + change, whole_path(study, change.substr(0, change.find('='))));
  return asked;
}

/// Whether a leaf changes a result whatever the source: name and seeds, and the grid in the figure.
bool counts_for_all(const Recording& recording, const Study& study, const std::string& path) {
  if (path == "name" || path == "seed" || path == "seeds") return true;
  if (!recording.has_scans()) return false;
  return path == "localization.grid" ||
         (path == "localization.grid_resolution_m" && !study.localization.grid);
}

}  // namespace

std::vector<std::string> localizing_sources() {
  std::vector<std::string> names;
  constexpr auto kNames = names_of(PoseSource{});
  for (std::size_t n = 0; n < kNames.size(); ++n)
    if (localises(static_cast<PoseSource>(n))) names.emplace_back(kNames[n]);
  return names;
}

Study study_of(const LocalizeFlags& flags) {
  Study study;
  study.name =
      shown((fs::absolute(flags.recording) / "").lexically_normal().parent_path().filename());
  study.recording = flags.recording;
  study.methods = {{"direct", Direct{}}};  // a study has one; nothing is mapped here
  study.seed = flags.seed;
  study.seeds = flags.seeds;
  if (flags.source != kAllSources) set_leaf(study, "localization.source", flags.source);
  if (flags.model) set_leaf(study, "localization.filter.scan_model", *flags.model);
  set_leaf(study, "faults.lidar.preset", "rplidar_a2");
  if (flags.global_start) set_leaf(study, "localization.filter.start", "global");
  study.localization.grid = flags.grid;
  set_leaves(study, flags.overrides);
  check(study);
  return study;
}

std::string left_out(std::string_view source, std::string_view why) {
  return fmt::format("localize: not {}: {}\n", source, why);
}

std::vector<std::string> chosen_sources(const LocalizeFlags& flags, const Study& study,
                                        const Recording& recording, std::string& notes) {
  if (flags.source != kAllSources) return {flags.source};
  std::vector<std::string> sources;
  for (const std::string& source : localizing_sources()) {
    const std::string missing = missing_for(source, study, recording);
    if (missing.empty())
      sources.push_back(source);
    else
      notes += left_out(source, missing);
  }
  return sources;
}

void refuse_without_effect(const LocalizeFlags& flags, const Study& study,
                           const Recording& recording, const std::vector<std::string>& sources) {
  std::vector<Study> studies;
  std::set<std::string> keys;
  for (const std::string& source : sources) {
    set_leaf(studies.emplace_back(study), "localization.source", source);
    for (std::string& key : keys_of_poses(studies.back().localization)) keys.insert(std::move(key));
  }
  for (const auto& [words, path] : asked_leaves(flags, study)) {
    const auto counts = [&](const Study& of) { return decides_poses(of, path); };
    if (counts_for_all(recording, study, path) || std::ranges::any_of(studies, counts)) continue;
    throw Error(fmt::format(
        "{}: has no effect with --source {} and what else is given; leave it out (keys that count "
        "begin with {})",
        words, flags.source, fmt::join(keys, ", ")));
  }
}

void LocalizeFlags::add_to(CLI::App& verb) {
  std::vector<std::string> sources = localizing_sources();
  sources.emplace_back(kAllSources);
  verb.add_option("--source", source,
                  fmt::format("One of {}; all: each that the recording has something for, side by "
                              "side",
                              fmt::join(sources, ", ")))
      ->check(CLI::IsMember(sources))
      ->capture_default_str();
  verb.add_option("--model", model, "Of a scan: likelihood_field or beam [likelihood_field]")
      ->check(CLI::IsMember({"likelihood_field", "beam"}));
  verb.add_flag("--global", global_start, "Start anywhere, not near the true start");
  verb.add_option("--grid", grid,
                  "YAML of a ROS map_server grid in the scene's world; default: cut from the "
                  "truth at the lidar's height");
  verb.add_option("--seeds", seeds,
                  "Repetitions, each with noise and draws of its own: those of a study")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  verb.add_option("--seed", seed, "Of all draws, as a study's `seed`")->capture_default_str();
  verb.add_option(
          "--set", overrides,
          "A key of a study that decides the poses of the source: localization.*, faults.lidar.*, "
          "faults.depth.* or faults.mount.*; may be repeated")
      ->allow_extra_args(false);
  verb.add_flag("-q,--quiet", quiet, "No progress");
  style.add_to(verb);
}

}  // namespace mapscore::eval
