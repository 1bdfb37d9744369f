// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/study/study_tree.hpp"

#include <algorithm>

// Studies of several scenes.

namespace mapscore::eval {
namespace {

/// Whether the path ends at a section, whose keys are read one by one; or at nothing.
bool is_section(Study& study, const std::string& path) try {
  at_leaf_below(YamlValue{{}, "", 0, path}, study, path, [](const StudyLeaf&) {});
  return false;
} catch (const Error&) {
  return true;
}

/// Takes what stands at a path into `scene`, as `probe`, a study with these leaves, has it.
void take(const YamlValue& at, const std::string& path, Study& probe, SceneSettings& scene) {
  if (at.node.IsMap() && !at.entries().empty() && is_section(probe, path)) {
    for (const auto& [key, child] : at.entries()) take(child, path + '.' + key, probe, scene);
    return;
  }
  set_leaf(probe, path, at);
  scene.leaves.emplace_back(path, leaf_text(probe, path));
  if (!at.node.IsMap()) return;  // else a choice, {kind: {...}}
  for (const auto& [kind, section] : at.entries())
    for (const auto& [key, child] : section.entries())
      take(child, fmt::format("{}.{}.{}", path, kind, key), probe, scene);
}

std::vector<std::string> names_of(const Scenes& scenes) {
  std::vector<std::string> names;
  for (const SceneSettings& scene : scenes) names.push_back(scene.name);
  return names;
}

}  // namespace

void read_scenes(const YamlValue& at, Scenes& scenes) {
  scenes.clear();
  for (const auto& [name, entry] : at.entries()) {
    check_word(entry, name, "scene");
    if (yaml_text(name) != name)
      entry.fail(fmt::format("{} cannot name a scene; begin it with a letter", name));
    if (name == kAllScenes)
      entry.fail("the name stands for all scenes together in tables; write another one");
    SceneSettings scene{name};
    Study probe;
    for (const auto& [key, value] : entry.entries()) {
      if (!decides_recording(key))
        value.fail("does not decide a recording; write it beside `scenes`, for all of them");
      take(value, key, probe, scene);
    }
    const auto renders = [](const auto& leaf) {
      const std::string_view key = split_path(leaf.first).first;
      return key == "trajectory" || key == "cameras" || key == "lidar" || key == "exploration";
    };
    if (probe.recording && std::ranges::any_of(scene.leaves, renders))
      entry.at("recording")
          .fail(
              "is replayed as it is; leave trajectory, cameras, lidar and exploration out of this "
              "scene");
    scenes.push_back(std::move(scene));
  }
}

Study with_scene(Study study, const std::string& name) {
  const auto scene = std::ranges::find(study.scenes, name, &SceneSettings::name);
  if (scene == study.scenes.end())
    throw Error(fmt::format("{}: no scene '{}'; {}", kSceneAxis, name,
                            suggestion(name, names_of(study.scenes))));
  const SceneSettings settings = *scene;
  study.scenes.clear();
  std::erase_if(study.sweep, [](const SweepAxis& axis) { return axis.path == kSceneAxis; });
  for (const auto& [path, text] : settings.leaves) set_leaf(study, path, text);
  return study;
}

std::vector<std::pair<std::string, Study>> studies_of_scenes(const Study& study) {
  if (study.scenes.empty()) return {{"", study}};
  std::vector<std::pair<std::string, Study>> studies;
  const auto axis = std::ranges::find(study.sweep, kSceneAxis, &SweepAxis::path);
  for (const std::string& name : axis == study.sweep.end() ? names_of(study.scenes) : axis->values)
    studies.emplace_back(name, with_scene(study, name));
  return studies;
}

Study study_of_only_scene(const Study& study) {
  const auto studies = studies_of_scenes(study);
  if (studies.size() > 1)
    throw Error(fmt::format("scenes: there are {}, and this takes one; --set sweep.scene=[{}]",
                            studies.size(), studies.front().first));
  return studies.front().second;
}

}  // namespace mapscore::eval
