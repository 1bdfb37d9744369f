// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/input_files.hpp"

#include "core/error.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/grid_file.hpp"
#include "eval/results/study_store.hpp"
#include "eval/study/grid.hpp"
#include "files/file_bytes.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
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

NetworkImages images_of_folder(const Study& config, const ImagePerception& settings) {
  NetworkImages images{resolve_path(config, settings.folder.value()),
                       resolve_path(config, settings.classes.value()), settings.masks};
  if (settings.scores) images.scores = resolve_path(config, *settings.scores);
  if (settings.confidence) images.confidence = resolve_path(config, *settings.confidence);
  return images;
}

NetworkModel network_model(const Study& config, const NetworkPerception& settings) {
  return {.model = resolve_path(config, settings.model.value()),
          .classes = resolve_path(config, settings.classes.value()),
          .channels = settings.channels,
          .scale = settings.scale,
          .mean = settings.mean,
          .std = settings.std,
          .output = settings.output};
}

/// The class file of a configuration's network or label images, and how these are cut.
std::optional<std::pair<std::filesystem::path, ClassMasks>> class_file(const Study& config) {
  if (const auto* images = std::get_if<ImagePerception>(&config.perception))
    return std::pair(resolve_path(config, images->classes.value()), images->masks);
  if (const auto* network = std::get_if<NetworkPerception>(&config.perception))
    return std::pair(resolve_path(config, network->classes.value()), ClassMasks::components);
  return std::nullopt;
}

/// Calls act(config) for the study, or for each cell of a sweep over what names files.
void for_each_input(const Study& study, const auto& act) {
  const bool swept = std::ranges::any_of(study.sweep, [](const SweepAxis& axis) {
    return axis.path.starts_with("localization.") || axis.path.starts_with("perception");
  });
  if (!swept) return act(study);  // every cell reads the same ones
  for (const Cell& cell : cells(study)) act(resolve(study, cell));
}

/// The networks that run at the points of a study's grid, each once.
std::vector<NetworkModel> networks_of(const Study& study) {
  std::vector<NetworkModel> networks;
  for_each_input(study, [&](const Study& config) {
    const auto* settings = std::get_if<NetworkPerception>(&config.perception);
    if (settings == nullptr) return;
    const NetworkModel network = network_model(config, *settings);
    if (std::ranges::find(networks, network) == networks.end()) networks.push_back(network);
  });
  return networks;
}

}  // namespace

const std::string& InputFiles::of(const std::string& name,
                                  const std::function<std::string()>& read) {
  const auto [entry, is_new] = hashes_.try_emplace(name);
  if (is_new && are_known_)
    throw Error(fmt::format("the hash of '{}' is not stored; sweep again", shown(name)));
  if (is_new) entry->second = hash_of(read());
  return entry->second;
}

std::string InputFiles::perceived(const Study& config) {
  if (const auto* simulated = std::get_if<SimulatedPerception>(&config.perception);
      simulated && simulated->objects)
    return of("objects " + *simulated->objects,
              [&] { return read_file(resolve_path(config, *simulated->objects)); });
  if (const auto* network = std::get_if<NetworkPerception>(&config.perception))
    return of(fmt::format("network {}\n{}", network->model.value(), network->classes.value()),
              [&] { return content_of(network_model(config, *network)); });
  const auto* images = std::get_if<ImagePerception>(&config.perception);
  if (images == nullptr) return "";
  return of(fmt::format("images {}\n{}\n{}{}", images->folder.value(), images->classes.value(),
                        images->scores.value_or(""),
                        images->confidence ? "\n" + *images->confidence : ""),
            [&] { return content_of(images_of_folder(config, *images)); });
}

std::string InputFiles::poses(const Study& config) {
  const LocalizationSettings& settings = config.localization;
  if (settings.source == PoseSource::trajectory)
    return of("trajectory " + settings.trajectory.value(),
              [&] { return trajectory_bytes(resolve_path(config, settings.trajectory.value())); });
  if (settings.source == PoseSource::particle_filter && settings.grid)
    return of("grid " + *settings.grid,
              [&] { return grid_bytes(resolve_path(config, *settings.grid)); });
  return "";
}

std::vector<std::string> InputFiles::depends(const Study& config) {
  const auto& command = config.methods.front().command;
  if (!command) return {};
  std::vector<std::string> files;
  const auto add = [&](const std::string& file) {
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const std::string& word : command->command)
    if (are_known_ ? hashes_.contains("file " + word) : file_beside(config, word).has_value())
      add(word);
  for (const std::string& file : command->depends) {
    if (!are_known_ && !std::filesystem::is_regular_file(resolve_path(config, file)))
      throw Error(fmt::format("methods.{}.depends: there is no file '{}' beside the study; {}",
                              config.methods.front().name, shown(file),
                              path_suggestion(resolve_path(config, file), "mend its path")));
    add(file);
  }
  std::vector<std::string> hashes;
  for (const std::string& file : files)
    hashes.push_back(of("file " + file, [&] { return read_file(resolve_path(config, file)); }));
  return hashes;
}

std::optional<NetworkImages> network_images(const Study& config, const Recording& recording) {
  if (const auto* images = std::get_if<ImagePerception>(&config.perception))
    return images_of_folder(config, *images);
  const auto* network = std::get_if<NetworkPerception>(&config.perception);
  if (network == nullptr) return std::nullopt;
  return inferred_images(network_model(config, *network), recording, recording.results());
}

InputFiles::Hashes check_input_files(const Study& study) {
  InputFiles files;
  for_each_input(study, [&](const Study& config) {
    static_cast<void>(files.poses(config));
    static_cast<void>(files.perceived(config));
  });
  return files.hashes();
}

void check_network_labels(const Study& study, const Recording& recording) {
  std::set<NetworkImages> checked;
  for_each_input(study, [&](const Study& config) {
    const auto* settings = std::get_if<ImagePerception>(&config.perception);
    if (settings == nullptr) return;
    const NetworkImages images = images_of_folder(config, *settings);
    if (checked.insert(images).second)
      NetworkLabels(images, recording, detected_table(config, recording.info().table)).check();
  });
  for (const NetworkModel& network : networks_of(study)) check_network(network, recording);
}

std::string note_on_labels(const Study& study, const Recording& recording) {
  std::map<std::filesystem::path, std::string> unnamed;  // by class file
  for_each_input(study, [&](const Study& config) {
    const auto file = class_file(config);
    if (!file) return;
    const auto [path, masks] = *file;
    const ClassTable table = detected_table(config, recording.info().table);
    const std::vector<ClassId> named =
        classes_of_values(read_label_classes(path, masks), path, masks, table);
    std::string& names = unnamed[path];
    names.clear();
    for (const SemanticClass& c : table.classes)
      if (c.detect && c.id != kBackground && std::ranges::find(named, c.id) == named.end())
        names += (names.empty() ? "" : ", ") + c.name;
  });
  std::string note;
  for (const auto& [path, names] : unnamed)
    if (!names.empty())
      note +=
          fmt::format("{}{} has no label for {}: with it, these detected classes are never found",
                      note.empty() ? "" : "; ", shown(path), names);
  return note;
}

void infer_networks(const Study& study, const Recording& recording, int jobs,
                    const std::function<void(int, int)>& progress) {
  const std::vector<NetworkModel> networks = networks_of(study);
  int before = 0;
  const int all = static_cast<int>(networks.size()) * recording.frame_count();
  for (const NetworkModel& network : networks) {
    remove_damaged_images(network, recording, recording.results());
    static_cast<void>(
        inferred_images(network, recording, recording.results(), jobs, [&](int done, int) {
          if (progress) progress(before + done, all);
        }));
    before += recording.frame_count();
  }
}

}  // namespace mapscore::eval
