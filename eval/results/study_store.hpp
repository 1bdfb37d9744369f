// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/plan.hpp"
#include "eval/results/store.hpp"
#include "eval/study/study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// What a store says of one scene of a study.
struct SceneRecord {
  std::string name, recording_hash;
  std::string recording;             ///< folder, relative to the store's
  std::vector<std::string> classes;  ///< names by class id, as its trials count them
};

/// What a store says of the study that was swept into it last; enough to read its results anywhere.
struct StudyRecord {
  Study study;
  ClassTable table;  ///< with the study's detected set
  std::string recording_hash;
  std::string recording;  ///< folder, relative to the store's
  /// Of a study with scenes. `table` is then that of all classes of all scenes without instances,
  /// `recording_hash` a hash of theirs, and `recording` empty.
  std::vector<SceneRecord> scenes = {};
  /// Of the files that its trials read; none in a store of before they were kept.
  std::optional<InputFiles::Hashes> inputs = {};

  [[nodiscard]] RecordingHashes hashes() const;
};

/// The plan of what was swept, whatever has become of the files that its trials read.
[[nodiscard]] Plan plan_of(const StudyRecord& record);

/// The record of a study on its scenes, by name; of one without scenes, on the only one. Throws
/// Error when a class is detected in one scene and not in another.
[[nodiscard]] StudyRecord record_of(const Study& study,
                                    const std::vector<std::pair<SceneRecord, ClassTable>>& scenes);

/// Writes the record, with the version of the program. `folder` is the store's; the study's own is
/// kept relative to it, so that both can be moved together.
void write_study(ResultStore& store, const StudyRecord& record,
                 const std::filesystem::path& folder);
/// Throws Error when the store holds none.
[[nodiscard]] StudyRecord read_study(const ResultStore& store, const std::filesystem::path& folder);

/// Throws Error where a file that poses or detections of `study` come from is not as it was when
/// the hashes of `record` were taken; `study` is the record's, or that of one of its scenes.
void check_inputs(const StudyRecord& record, const Study& study);

/// The recording that the record's trials were made on; `folder` is the store's. Throws Error when
/// it is not there, or is another one now, or there is none of the scene.
[[nodiscard]] Recording recording_of(const StudyRecord& record, const std::filesystem::path& folder,
                                     const std::string& scene = "");

/// The record of one scene by itself, as if its study had no other, with its recording. Throws as
/// recording_of.
[[nodiscard]] std::pair<StudyRecord, Recording> scene_of(const StudyRecord& record,
                                                         const std::filesystem::path& folder,
                                                         const std::string& scene);

/// The class table of a recording with the study's `detect`. Throws Error when no class is
/// detected, or naming a class that stands for all in tables ("pooled", "macro", "all") or is not
/// there.
[[nodiscard]] ClassTable detected_table(const Study& study, ClassTable table);
/// The same for the names of a flag `--detect`; {"all"}: every class.
[[nodiscard]] ClassTable detected_table(const std::vector<std::string>& classes, ClassTable table);

}  // namespace mapscore::eval
