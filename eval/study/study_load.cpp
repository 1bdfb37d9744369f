// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/study/study_tree.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mapscore::eval {
namespace {

constexpr std::string_view kSweepKey = "sweep";
constexpr std::string_view kSweepPrefix = "sweep.";

/// One `path=value` of a flag.
struct Override {
  std::string path;
  YamlValue at;
};

Override parse_override(const std::string& text) {
  const std::string source = "flag " + text;
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) throw Error(source + ": write it as path=value");
  const std::string path = text.substr(0, equals);
  return {path, parse_yaml_value(text.substr(equals + 1), source, path)};
}

/// Swept paths with their lists of values, before the types of the leaves are known.
class RawSweep {
 public:
  /// Takes the place of all there was.
  void replace_all(const YamlValue& at) { axes_ = at.entries(); }

  /// Takes the place of one axis, or adds it.
  void replace(const std::string& path, const YamlValue& values) {
    const auto axis = std::ranges::find(axes_, path, &Axis::first);
    if (axis == axes_.end())
      axes_.emplace_back(path, values);
    else
      axis->second = values;
  }

  [[nodiscard]] bool holds(const std::string& path) const {
    return std::ranges::find(axes_, path, &Axis::first) != axes_.end();
  }

  /// Reads each value as the leaf that it is for.
  [[nodiscard]] Sweep read(const Study& study) const {
    Sweep sweep;
    for (const auto& [path, values] : axes_) sweep.push_back(read_axis(study, path, values));
    return sweep;
  }

 private:
  using Axis = std::pair<std::string, YamlValue>;

  static SweepAxis read_axis(const Study& study, const std::string& path, const YamlValue& values) {
    Study probe = study;
    at_leaf_below(values, probe, path, [&](const StudyLeaf& leaf) {
      if (!leaf.field.swept) values.fail(fmt::format("{} cannot be swept; remove it", path));
    });
    SweepAxis axis{path, {}};
    for (const YamlValue& value : values.elements()) {
      set_dose(probe, path, value);
      std::string text = leaf_text(probe, path);
      if (std::ranges::find(axis.values, text) != axis.values.end())
        value.fail(fmt::format("{} stands twice; keep one", text));
      axis.values.push_back(std::move(text));
    }
    if (axis.values.empty()) values.fail("has no values; write at least one");
    return axis;
  }

  std::vector<Axis> axes_;
};

/// Makes a short path whole.
void complete(Override& change, const Study& study) try {
  const std::string before(change.path.starts_with(kSweepPrefix) ? kSweepPrefix : "");
  change.path = before + whole_path(study, change.path.substr(before.size()));
  change.at.path = change.path;
} catch (const Error& error) {
  throw Error(change.at.source + ": " + error.what());
}

void apply(const Override& change, Study& study, RawSweep& sweep) {
  if (change.path == kSweepKey) {
    sweep.replace_all(change.at);
  } else if (change.path.starts_with(kSweepPrefix)) {
    sweep.replace(change.path.substr(kSweepPrefix.size()), change.at);
  } else {
    set_leaf(study, change.path, change.at);
  }
}

/// A flag must not be overruled by the doses of a sweep without a word.
void refuse_swept(const std::vector<Override>& overrides, const RawSweep& sweep) {
  for (const Override& change : overrides)
    if (sweep.holds(change.path))
      change.at.fail(fmt::format("is swept; set sweep.{}=[...] instead", change.path));
}

/// Nor by what a swept scene sets itself.
void refuse_overruled(const std::vector<Override>& overrides, const Study& study) {
  const auto within = [](const std::string& path, const std::string& of) {
    return path == of || path.starts_with(of + '.');
  };
  const auto axis = std::ranges::find(study.sweep, kSceneAxis, &SweepAxis::path);
  if (study.scenes.empty() || axis == study.sweep.end()) return;
  for (const Override& change : overrides) {
    const auto sets_it = [&](const auto& leaf) {
      return within(leaf.first, change.path) || within(change.path, leaf.first);
    };
    std::vector<std::string> scenes;
    for (const SceneSettings& scene : study.scenes)
      if (std::ranges::count(axis->values, scene.name) > 0 &&
          std::ranges::any_of(scene.leaves, sets_it))
        scenes.push_back(scene.name);
    if (scenes.empty()) continue;
    change.at.fail(
        fmt::format("{} set{} it below scenes, which wins; change it there, or set sweep.{}=[...] "
                    "for all scenes",
                    fmt::join(scenes, ", "), scenes.size() == 1 ? "s" : "", change.path));
  }
}

/// Who explores drives on wheels where nothing else is written.
void put_explorers_on_wheels(Study& study, const YamlValue& root,
                             const std::vector<Override>& overrides) {
  const bool exploring =
      explores(study) || std::ranges::any_of(study.scenes, [](const auto& scene) {
        return std::ranges::count(scene.leaves, "exploration.planner",
                                  [](const auto& leaf) { return leaf.first; }) > 0;
      });
  const bool in_file = root.has("trajectory") && root.at("trajectory").has("drive");
  if (exploring && !in_file &&
      std::ranges::find(overrides, "trajectory.drive", &Override::path) == overrides.end())
    study.trajectory.drive = WheelDrive{};
}

/// Where a value came from: the last flag that set it, otherwise the file.
YamlValue source_of(std::string_view path, const YamlValue& root,
                    const std::vector<Override>& overrides) {
  for (auto change = overrides.rbegin(); change != overrides.rend(); ++change)
    if (change->path == path) return change->at;
  return find(root, path);
}

/// Scenes are swept, the last path of all where the sweep does not name them.
void sweep_scenes(Study& study) {
  if (study.scenes.empty() || std::ranges::count(study.sweep, kSceneAxis, &SweepAxis::path) > 0)
    return;
  SweepAxis axis{std::string(kSceneAxis), {}};
  for (const SceneSettings& scene : study.scenes) axis.values.push_back(scene.name);
  study.sweep.push_back(std::move(axis));
}

/// A recording is replayed as it is. Keys of the file stay where a flag alone names the recording,
/// which then takes the place of what they would render.
void refuse_beside_recording(const Study& study, const YamlValue& root,
                             const std::vector<Override>& overrides) {
  const auto is_of = [](const std::string& path, const std::string& key) {
    return path == key || path.starts_with(key + '.');
  };
  const bool in_file = root.has("recording");
  if (!in_file && std::ranges::find(overrides, "recording", &Override::path) == overrides.end())
    return;
  for (const std::string key : {"trajectory", "cameras", "lidar", "exploration"}) {
    constexpr const char* kWhy =
        "cannot act beside recording, which is replayed as it is; remove it";
    for (const Override& change : overrides)
      if (is_of(change.path, key)) change.at.fail(kWhy);
    if (in_file && root.has(key)) find(root, key).fail(kWhy);
  }
  const bool asked = (in_file && root.has("scene")) ||
                     std::ranges::find(overrides, "scene", &Override::path) != overrides.end();
  if (asked && !std::filesystem::exists(resolve_path(study, *study.scene)))
    source_of("scene", root, overrides)
        .fail(fmt::format("{} is not there; beside recording pictures show this scene: mend the "
                          "path, or remove it",
                          *study.scene));
}

}  // namespace

Study parse_study(const std::string& text, const std::filesystem::path& file,
                  const std::vector<std::string>& override_texts) {
  const YamlValue root = parse_yaml(text, file.generic_string());
  std::vector<Override> overrides;
  for (const std::string& one : override_texts) overrides.push_back(parse_override(one));

  Study study;
  study.name = file.stem().string();
  study.base_folder = file.parent_path();
  read_section(root, study);
  RawSweep sweep;
  for (const auto& [key, value] : root.entries())
    if (key == kSweepKey) sweep.replace_all(value);
  for (Override& change : overrides) {
    complete(change, study);
    apply(change, study, sweep);
  }
  refuse_swept(overrides, sweep);
  study.sweep = sweep.read(study);
  sweep_scenes(study);
  refuse_overruled(overrides, study);
  put_explorers_on_wheels(study, root, overrides);
  check(study, [&](std::string_view path, const std::string& problem) {
    source_of(path, root, overrides).fail(problem);
  });
  return study;
}

Study load_study(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::ifstream stream(file, std::ios::binary);
  const std::string name = file.generic_string();
  if (!stream || std::filesystem::is_directory(file))
    throw Error(name + ": cannot be read; " +
                path_suggestion(file, "give the path of a study file"));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  Study study = parse_study(text, file, overrides);
  std::vector<Override> changes;
  for (const std::string& one : overrides)
    complete(changes.emplace_back(parse_override(one)), study);
  refuse_beside_recording(study, parse_yaml(text, name), changes);
  return study;
}

}  // namespace mapscore::eval
