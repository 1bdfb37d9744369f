// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/input_files.hpp"

#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/results/study_store.hpp"
#include "eval/study/grid.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <variant>

namespace mapscore::eval {
namespace {

std::string trajectory_bytes(const std::filesystem::path& file) {
  static_cast<void>(read_believed(file));  // refuses what is no trajectory
  return read_file(file);
}

std::string grid_bytes(const std::filesystem::path& file) {
  const OccupancyGrid grid = load_grid(file);
  const GridFrame& frame = grid.frame();
  std::string bytes =
      fmt::format("{} {} {} {} {} {}\n", frame.resolution_m, frame.T_map_grid.x_m,
                  frame.T_map_grid.y_m, frame.T_map_grid.yaw_rad, frame.width, frame.height);
  bytes.append(grid.cells().begin(), grid.cells().end());
  return bytes;
}

/// Calls act(config) for the study, or for each cell of a sweep over what names files.
void for_each_input(const Study& study, const auto& act) {
  const bool swept = std::ranges::any_of(study.sweep, [](const SweepAxis& axis) {
    return axis.path.starts_with("localization.") || axis.path.starts_with("perception");
  });
  if (!swept) return act(study);  // every cell reads the same ones
  for (const Cell& cell : cells(study)) act(resolve(study, cell));
}

}  // namespace

std::string InputFiles::of(const std::filesystem::path& file, auto read) {
  const auto [entry, is_new] = hashes_.try_emplace(file.string());
  if (is_new) entry->second = hash_of(read(file));
  return entry->second;
}

std::string InputFiles::perceived(const Study& config) {
  if (const auto* simulated = std::get_if<SimulatedPerception>(&config.perception);
      simulated && simulated->objects)
    return of(resolve_path(config, *simulated->objects), read_file);
  if (const auto* settings = std::get_if<ImagePerception>(&config.perception)) {
    const NetworkImages images = network_images(config, *settings);
    const std::string all =
        fmt::format("{}\n{}\n{}", images.folder.string(), images.classes.string(),
                    images.scores.value_or("").string());
    return of(all, [&](const auto&) { return content_of(images); });
  }
  return "";
}

std::string InputFiles::poses(const Study& config) {
  const LocalizationSettings& settings = config.localization;
  if (settings.source == PoseSource::trajectory)
    return of(resolve_path(config, settings.trajectory.value()), trajectory_bytes);
  if (settings.source == PoseSource::particle_filter && settings.grid)
    return of(resolve_path(config, *settings.grid), grid_bytes);
  return "";
}

std::vector<std::string> InputFiles::depends(const Study& config) {
  const auto& command = config.methods.front().command;
  if (!command) return {};
  std::vector<std::filesystem::path> files;
  for (const std::string& word : command->command)
    if (const auto file = file_beside(config, word)) files.push_back(*file);
  for (const std::string& file : command->depends)
    files.push_back(std::filesystem::absolute(resolve_path(config, file)));
  std::vector<std::string> hashes;
  for (auto file = files.begin(); file != files.end(); ++file)
    if (std::find(files.begin(), file, *file) == file) hashes.push_back(of(*file, read_file));
  return hashes;
}

NetworkImages network_images(const Study& config, const ImagePerception& settings) {
  NetworkImages images{resolve_path(config, settings.folder.value()),
                       resolve_path(config, settings.classes.value()),
                       settings.masks,
                       {}};
  if (settings.scores) images.scores = resolve_path(config, *settings.scores);
  return images;
}

void check_input_files(const Study& study) {
  InputFiles files;
  for_each_input(study, [&](const Study& config) {
    static_cast<void>(files.poses(config));
    static_cast<void>(files.perceived(config));
  });
}

void check_network_labels(const Study& study, const Recording& recording) {
  std::set<NetworkImages> checked;
  for_each_input(study, [&](const Study& config) {
    const auto* settings = std::get_if<ImagePerception>(&config.perception);
    if (settings == nullptr) return;
    const NetworkImages images = network_images(config, *settings);
    if (checked.insert(images).second)
      NetworkLabels(images, recording, detected_table(config, recording.info().table)).check();
  });
}

}  // namespace mapscore::eval
