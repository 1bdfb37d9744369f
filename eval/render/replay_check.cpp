// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/replay_check.hpp"

#include "core/error.hpp"
#include "core/fusion/fusion_rule.hpp"
#include "eval/results/study_store.hpp"
#include "eval/study/grid.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace mapscore::eval {
namespace {

void check_matrix(const Overrides<sim::LabelDose>& labels, const ClassTable& detected) {
  if (!labels.given.contains("confusion_matrix")) return;
  std::vector<std::string> names;
  for (const SemanticClass& c : detected.classes)
    if (c.detect) names.push_back(c.name);
  if (labels.values.confusion_matrix.size() != names.size())
    throw Error(fmt::format(
        "faults.labels.confusion_matrix: has {} rows, but {} classes are detected ({}); write a "
        "row and a column for each, in this order",
        labels.values.confusion_matrix.size(), names.size(), fmt::join(names, ", ")));
}

/// By the very functions of a trial.
void check_fusion(const Study& study, const ClassTable& detected) {
  static_cast<void>(for_classes(study.fusion, detected));
  for (const MethodSettings& method : study.methods) try {
      static_cast<void>(for_classes(fusion_of(study.fusion, method.fusion), detected));
    } catch (const Error& error) {
      throw Error("methods." + method.name + "." + error.what());
    }
}

void check_baked(const Study& study, const RecordingInfo& info) {
  if (!info.baked) return;
  const auto refuse = [&](const char* section, const std::string& baked) {
    throw Error(
        fmt::format("{}: the recording has such faults baked in ({}); replay the exact "
                    "recording, or set {}={{}}",
                    section, baked, section));
  };
  if (!info.baked->depth.empty() && !is_zero(study.faults.depth.dose()))
    refuse("faults.depth", info.baked->depth);
  if (!info.baked->labels.empty() && !is_zero(study.faults.labels.dose()))
    refuse("faults.labels", info.baked->labels);
}

}  // namespace

void check_classes(const Study& study, const ClassTable& table) {
  for (const Cell& cell : cells(study)) {
    const Study point = resolve(study, cell);
    const ClassTable detected = detected_table(point, table);
    check_matrix(point.faults.labels.own, detected);
    check_fusion(point, detected);
  }
}

void check_replay(const Study& study, const RecordingInfo& info) {
  check_classes(study, info.table);
  if (info.baked)
    for (const Cell& cell : cells(study)) check_baked(resolve(study, cell), info);
}

std::string note_on_scene(const Study& study, const RecordingInfo& info) {
  if (!study.recording || !study.scene) return {};
  const std::string scene = std::filesystem::path(*study.scene).filename().string();
  if (scene == info.scene) return {};
  return fmt::format(
      "note: {} is not the scene that was recorded{}; pictures show the recorded surfaces in the "
      "colours of their classes",
      shown(scene), info.scene.empty() ? "" : ", " + shown(info.scene));
}

std::string note_on_baked(const RecordingInfo& info) {
  if (!info.baked || info.baked->depth.empty()) return {};
  return fmt::format(
      "note: faults are baked into its depth ({}): visible truth and lattice ceiling count noisy "
      "samples; to score, replay the exact recording under faults.depth",
      info.baked->depth);
}

}  // namespace mapscore::eval
