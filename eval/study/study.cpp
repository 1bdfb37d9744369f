// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/study.hpp"

#include "core/error.hpp"
#include "eval/study/study_tree.hpp"

#include <algorithm>
#include <cmath>

namespace mapscore::eval {

void check_word(const YamlValue& at, const std::string& name, const char* of) {
  constexpr std::string_view kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (name.empty() || name.find_first_not_of(kAllowed) != name.npos)
    at.fail(fmt::format("{} cannot name a {}; use letters, digits, _ and -", yaml_text(name), of));
  if (name == "null" || name == "Null" || name == "NULL")
    at.fail(fmt::format("null cannot name a {}, since YAML reads it as nothing; write another name",
                        of));
}

void set_leaf(Study& study, std::string_view path, const YamlValue& at) {
  at_leaf_below(at, study, path, [&](const StudyLeaf& leaf) { leaf.read(at); });
}

void set_dose(Study& study, std::string_view path, const YamlValue& at) {
  at_leaf_below(at, study, path, [&](const StudyLeaf& leaf) {
    if (!leaf.choice) return leaf.read(at);
    const std::string kind = at.scalar("the name of a kind, whose parameters stand under the key");
    if (kind != leaf.text()) leaf.read(at);
  });
}

void set_dose(Study& study, std::string_view path, const std::string& yaml_value) {
  set_dose(study, path, parse_yaml_value(yaml_value, "", std::string(path)));
}

void set_leaf(Study& study, std::string_view path, const std::string& yaml_value) {
  set_leaf(study, path, parse_yaml_value(yaml_value, "", std::string(path)));
}

void set_leaves(Study& study, const std::vector<std::string>& overrides) {
  for (const std::string& override : overrides) {
    const std::size_t equals = override.find('=');
    if (equals == std::string::npos)
      throw Error("--set " + override + ": must be path=value, e.g. cameras.width_px=320");
    set_leaf(study, whole_path(study, override.substr(0, equals)), override.substr(equals + 1));
  }
}

std::string leaf_text(Study study, std::string_view path) {
  std::string text;
  at_leaf_below(YamlValue{{}, "", 0, std::string(path)}, study, path,
                [&](const StudyLeaf& leaf) { text = leaf.text(); });
  return text;
}

std::filesystem::path resolve_path(const Study& study, const std::string& path) {
  return (study.base_folder / path).lexically_normal();
}

std::optional<std::filesystem::path> file_beside(const Study& study, const std::string& word) {
  std::error_code none;
  const std::filesystem::path file = std::filesystem::absolute(resolve_path(study, word), none);
  if (none || word.empty() || !std::filesystem::is_regular_file(file, none)) return std::nullopt;
  return file;
}

std::filesystem::path robot_path(const Study& study) {
  if (study.robot) return resolve_path(study, *study.robot);
  if (!study.scene) throw Error("robot: neither robot nor scene is given; write robot: PATH");
  return resolve_path(study, *study.scene).parent_path() / "robot.xml";
}

Place place_of(const Study& study, const MethodSettings& method) {
  return method.place.value_or(study.place);
}

bool on_wheels(const Study& study) {
  return std::holds_alternative<WheelDrive>(study.trajectory.drive) || explores(study);
}

bool explores(const Study& study) {
  const bool swept = std::ranges::any_of(study.sweep, [](const SweepAxis& axis) {
    return axis.path.starts_with("exploration.planner");
  });
  return swept || !std::holds_alternative<NoExploration>(study.exploration.planner);
}

double depth_rate(const Study& study) {
  constexpr double kLeastDosed = 30.0;  // images per second
  if (study.trajectory.depth_frames_per_s) return *study.trajectory.depth_frames_per_s;
  const auto doses_offset = [](const SweepAxis& axis) {
    return axis.path == "faults.time_offset_ms";
  };
  const bool is_dosed =
      study.faults.time_offset_ms != 0.0 || std::ranges::any_of(study.sweep, doses_offset);
  const double colour = study.trajectory.frames_per_s;
  return is_dosed ? colour * std::ceil(kLeastDosed / colour) : colour;
}

DrawnFusion fusion_of(const DrawnFusion& of_study, const MethodFusion& of_method) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> DrawnFusion {
        if constexpr (std::same_as<Kind, StudyFusion>)
          return of_study;
        else
          return kind;
      },
      of_method);
}

std::vector<std::string> method_names(const Study& study) {
  std::vector<std::string> names;
  for (const MethodSettings& method : study.methods) names.push_back(method.name);
  return names;
}

std::string method_title(const Study& study, const std::string& name) {
  const auto method = std::ranges::find(study.methods, name, &MethodSettings::name);
  return method == study.methods.end() ? name : method->title.value_or(name);
}

std::string class_title(const Study& study, const std::string& name) {
  const auto title = study.class_titles.find(name);
  return title == study.class_titles.end() ? name : title->second;
}

Study without_titles(Study study) {
  study.class_titles.clear();
  for (MethodSettings& method : study.methods) method.title.reset();
  return study;
}

Study with_method(Study config, const std::string& name) {
  std::erase_if(config.methods, [&](const MethodSettings& method) { return method.name != name; });
  config.sweep.clear();
  config.sampling = {};
  for (MethodSettings& method : config.methods) {
    config.fusion = fusion_of(config.fusion, method.fusion);
    method.fusion = StudyFusion{};
  }
  return config;
}

Mapping mapping_of(const Study& study, const ClassTable& table) {
  const MethodSettings& method = study.methods.front();
  return {.voxel_m = study.voxel_m,
          .segmentation = method.segmentation,
          .place = place_of(study, method),
          .fusion = for_classes(study.fusion, table),
          .occupancy = study.occupancy,
          .frames = method.frames};
}

bool reads_colour(const Study& study) {
  return std::ranges::any_of(study.methods, [](const MethodSettings& method) {
    const auto* crf = std::get_if<Crf>(&method.refinement);
    return crf != nullptr && crf->reads_colour();
  });
}

Field field_of(Study study, std::string_view path) {
  Field found;
  at_leaf_below(YamlValue{{}, "", 0, std::string(path)}, study, path,
                [&](const StudyLeaf& leaf) { found = leaf.field; });
  return found;
}

bool is_whole_number(Study study, std::string_view path) {
  bool whole = false;
  at_leaf_below(YamlValue{{}, "", 0, std::string(path)}, study, path,
                [&](const StudyLeaf& leaf) { whole = leaf.whole; });
  return whole;
}

bool decides_recording(std::string_view path) {
  bool recorded = false;
  const Study any;
  Study::fields(any, [&](const auto&, const Field& field) {
    recorded = recorded || (field.recorded && field.key == split_path(path).first);
  });
  return recorded;
}

}  // namespace mapscore::eval
