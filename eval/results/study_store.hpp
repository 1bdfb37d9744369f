// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/recording/recording.hpp"
#include "eval/results/store.hpp"
#include "eval/study/study.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// What a store says of the study that was swept into it last; enough to read its results anywhere.
struct StudyRecord {
  Study study;
  ClassTable table;  ///< with the study's detected set
  std::string recording_hash;
  std::string recording;  ///< folder, relative to the store's
};

/// Writes the record, with the version of the program. `folder` is the store's; the study's own is
/// kept relative to it, so that both can be moved together.
void write_study(ResultStore& store, const StudyRecord& record,
                 const std::filesystem::path& folder);
/// Throws Error when the store holds none.
[[nodiscard]] StudyRecord read_study(const ResultStore& store, const std::filesystem::path& folder);

/// The recording that the record's trials were made on; `folder` is the store's. Throws Error when
/// it is not there, or is another one now.
[[nodiscard]] Recording recording_of(const StudyRecord& record,
                                     const std::filesystem::path& folder);

/// The class table of a recording with the study's `detect`. Throws Error when no class is
/// detected, or naming a class that stands for all in tables ("pooled", "macro", "all") or is not
/// there.
[[nodiscard]] ClassTable detected_table(const Study& study, ClassTable table);
/// The same for the names of a flag `--detect`; {"all"}: every class.
[[nodiscard]] ClassTable detected_table(const std::vector<std::string>& classes, ClassTable table);

}  // namespace mapscore::eval
