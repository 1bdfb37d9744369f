// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/study_store.hpp"

#include "core/error.hpp"
#include "eval/results/shards.hpp"
#include "files/file_bytes.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

using nlohmann::json;

std::string table_to_json(const ClassTable& table) {
  json object{{"classes", json::array()}, {"instances", json::array()}};
  for (const SemanticClass& c : table.classes)
    object["classes"].push_back({{"id", c.id},
                                 {"name", c.name},
                                 {"colour", {c.colour.r, c.colour.g, c.colour.b}},
                                 {"detect", c.detect}});
  for (const Instance& i : table.instances)
    object["instances"].push_back({{"id", i.id}, {"name", i.name}, {"class", i.class_id}});
  return object.dump();
}

std::string scenes_to_json(const std::vector<SceneRecord>& scenes) {
  json list = json::array();
  for (const SceneRecord& scene : scenes)
    list.push_back({{"name", scene.name},
                    {"recording_hash", scene.recording_hash},
                    {"recording", scene.recording},
                    {"classes", scene.classes}});
  return list.dump();
}

std::vector<SceneRecord> scenes_from_json(const std::string& text) {
  std::vector<SceneRecord> scenes;
  if (text.empty()) return scenes;
  for (const json& scene : json::parse(text))
    scenes.push_back(
        {scene.at("name"), scene.at("recording_hash"), scene.at("recording"), scene.at("classes")});
  return scenes;
}

const SceneRecord& scene_named(const StudyRecord& record, const std::string& name) {
  const auto scene = std::ranges::find(record.scenes, name, &SceneRecord::name);
  if (scene == record.scenes.end())
    throw Error(
        fmt::format("scene '{}': the study's trials are of none of this name; sweep again", name));
  return *scene;
}

/// Adds the classes that the table lacks. Throws Error where a class is detected in one alone.
void join_classes(const ClassTable& added, const std::string& scene, ClassTable& table) {
  for (const SemanticClass& c : added.classes) {
    const auto known = std::ranges::find(table.classes, c.name, &SemanticClass::name);
    if (known == table.classes.end()) {
      table.classes.push_back(c);
      table.classes.back().id = static_cast<ClassId>(table.classes.size() - 1);
    } else if (known->detect != c.detect) {
      throw Error(
          fmt::format("scenes.{}: class {} is {}detected there, not so in another scene; "
                      "name what is under the study's `detect`",
                      scene, c.name, c.detect ? "" : "not "));
    }
  }
}

/// Ids are places in the table, of which counts are kept by place.
void refuse_other_id(const json& entry, std::size_t place) {
  if (entry.at("id") != place)
    throw Error(
        fmt::format("result store: entry {} of the class table has another id; sweep again "
                    "into another folder",
                    place));
}

ClassTable table_from_json(const std::string& text) {
  const json object = json::parse(text);
  ClassTable table;
  table.classes.clear();
  table.instances.clear();
  for (const json& c : object.at("classes")) {
    refuse_other_id(c, table.classes.size());
    table.classes.push_back({c.at("id"),
                             c.at("name"),
                             {c.at("colour").at(0), c.at("colour").at(1), c.at("colour").at(2)},
                             c.at("detect")});
  }
  for (const json& i : object.at("instances")) {
    refuse_other_id(i, table.instances.size());
    if (i.at("class") >= table.classes.size())
      throw Error(
          fmt::format("result store: instance {} is of a class that its table lacks; sweep "
                      "again into another folder",
                      table.instances.size()));
    table.instances.push_back({i.at("id"), i.at("name"), i.at("class")});
  }
  for (const SemanticClass& c : table.classes)
    if (const auto unfit = unfit_as_name(c.name))
      throw Error("result store: the name of a class " + *unfit +
                  "; sweep again into another folder");
  return table;
}

/// Names that stand for all classes in tables and CSV.
void refuse_reserved_names(const ClassTable& table) {
  for (const SemanticClass& c : table.classes)
    if (c.name == "pooled" || c.name == "macro" || c.name == "all")
      throw Error("class '" + c.name +
                  "': the name stands for all classes in tables; rename it in the class file");
}

/// Of classes that there are.
void check_titles(const Study& study, const ClassTable& table) {
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes)
    if (c.id != kBackground) names.push_back(c.name);
  for (const auto& [name, title] : study.class_titles)
    require_one_of(names, name, fmt::format("class_titles: there is no class '{}'", name));
}

ClassTable with_detected_set(const Study& study, ClassTable table) {
  if (!study.detect) return table;
  std::string names;
  for (const SemanticClass& c : table.classes)
    if (c.id != kBackground) names += ' ' + c.name;
  for (const std::string& name : study.detect->classes)
    if (std::ranges::find(table.classes.begin() + 1, table.classes.end(), name,
                          &SemanticClass::name) == table.classes.end())
      throw Error(fmt::format("detect: there is no class '{}'; there are:{}", name, names));
  for (SemanticClass& c : table.classes)
    c.detect = c.id != kBackground &&
               (study.detect->all ||
                std::ranges::find(study.detect->classes, c.name) != study.detect->classes.end());
  return table;
}

/// `mapscore tolerance` adds trials, but binds the folder to no study.
std::string holds_no_study(const ResultStore& store) {
  const std::size_t trials = store.keys().size();
  return fmt::format(
      "result store: holds no study{}; run `mapscore sweep` first",
      trials > 0 ? fmt::format(", but {} trials of `mapscore tolerance`", trials) : "");
}

}  // namespace

RecordingHashes StudyRecord::hashes() const {
  if (scenes.empty()) return recording_hash;
  std::map<std::string, std::string> of_scenes;
  for (const SceneRecord& scene : scenes) of_scenes[scene.name] = scene.recording_hash;
  return RecordingHashes(std::move(of_scenes));
}

Plan plan_of(const StudyRecord& record) {
  return plan_of(record.study, record.hashes(),
                 record.inputs ? InputFiles(*record.inputs) : InputFiles());
}

StudyRecord record_of(const Study& study,
                      const std::vector<std::pair<SceneRecord, ClassTable>>& scenes) {
  if (study.scenes.empty()) {
    const auto& [only, table] = scenes.front();
    return {study, table, only.recording_hash, only.recording};
  }
  StudyRecord record{study, {}, "", ""};
  std::string hashes;
  for (const auto& [scene, table] : scenes) {
    join_classes(table, scene.name, record.table);
    hashes += scene.name + ' ' + scene.recording_hash + '\n';
    record.scenes.push_back(scene);
    for (const SemanticClass& c : table.classes) record.scenes.back().classes.push_back(c.name);
  }
  record.recording_hash = hash_of(hashes);
  return record;
}

void write_study(ResultStore& store, const StudyRecord& record,
                 const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const std::string base = fs::absolute(record.study.base_folder / ".")
                               .lexically_normal()
                               .lexically_relative(fs::absolute(folder).lexically_normal());
  store.set_texts({{"study_folder", base},
                   {"study", to_yaml(record.study)},
                   {"classes", table_to_json(record.table)},
                   {"recording_hash", record.recording_hash},
                   {"recording", record.recording},
                   {"mapscore_version", MAPSCORE_VERSION}});
  if (!record.scenes.empty() || !store.text("scenes").empty())
    store.set_text("scenes", record.scenes.empty() ? "" : scenes_to_json(record.scenes));
  store.set_text("inputs", json(record.inputs.value_or(InputFiles::Hashes{})).dump());
}

StudyRecord read_study(const ResultStore& store, const std::filesystem::path& folder) try {
  const std::string study = store.text("study");
  if (study.empty()) throw Error(holds_no_study(store));
  const std::filesystem::path base = folder / store.text("study_folder");
  std::optional<InputFiles::Hashes> inputs;
  if (const std::string text = store.text("inputs"); !text.empty())
    inputs = json::parse(text).get<InputFiles::Hashes>();
  return {parse_study(study, (base / "stored study").lexically_normal()),
          table_from_json(store.text("classes")),
          store.text("recording_hash"),
          store.text("recording"),
          scenes_from_json(store.text("scenes")),
          inputs};
} catch (const json::exception& error) {
  throw Error(std::string("result store: the record of its study is not readable (") +
              error.what() + "); sweep again into another folder");
}

void check_inputs(const StudyRecord& record, const Study& study) {
  if (!record.inputs) return;
  for (const auto& [name, hash] : check_input_files(study)) {
    const auto swept = record.inputs->find(name);
    if (swept != record.inputs->end() && swept->second != hash)
      throw Error(fmt::format("{}: is not as it was when it was swept; sweep again",
                              shown(name.substr(0, name.find('\n')))));
  }
}

Recording recording_of(const StudyRecord& record, const std::filesystem::path& folder,
                       const std::string& scene) {
  const bool only = record.scenes.empty();
  const std::string& path = only ? record.recording : scene_named(record, scene).recording;
  const std::filesystem::path place = (folder / path).lexically_normal();
  Recording recording = Recording::open(place);
  if (recording.content_hash() !=
      (only ? record.recording_hash : scene_named(record, scene).recording_hash))
    throw Error(place.string() +
                ": is another recording than that of the study's trials; sweep again");
  recording.keep_in(whole_folder(folder));
  return recording;
}

std::pair<StudyRecord, Recording> scene_of(const StudyRecord& record,
                                           const std::filesystem::path& folder,
                                           const std::string& scene) {
  Recording recording = recording_of(record, folder, scene);
  if (record.scenes.empty()) return {record, std::move(recording)};
  const Study study = with_scene(record.study, scene);
  StudyRecord only{study, detected_table(study, recording.info().table), recording.content_hash(),
                   scene_named(record, scene).recording};
  return {std::move(only), std::move(recording)};
}

ClassTable detected_table(const Study& study, ClassTable table) {
  refuse_reserved_names(table);
  check_titles(study, table);
  table = with_detected_set(study, std::move(table));
  if (std::ranges::none_of(table.classes, &SemanticClass::detect))
    throw Error(
        "detect: no class of the scene is detected, so there is nothing to map; set `detect: true` "
        "in the "
        "class file, or name classes under the study's `detect`");
  return table;
}

ClassTable detected_table(const std::vector<std::string>& classes, ClassTable table) {
  Study study;
  study.detect = classes == std::vector<std::string>{"all"} ? DetectedSet{true, {}}
                                                            : DetectedSet{false, classes};
  return detected_table(study, std::move(table));
}

}  // namespace mapscore::eval
