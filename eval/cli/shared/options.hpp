// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/tables/table.hpp"
#include "eval/study/study.hpp"
#include "files/folder_lock.hpp"
#include "sim/render/renderer.hpp"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mapscore::eval {

/// Flags that say which study, with what changed, and where its results go.
struct StudyFlags {
  std::string file;
  std::vector<std::string> overrides;  ///< path=value
  std::string results;

  void add_to(CLI::App& verb, const char* shown_as = "STUDY",
              const char* help = "Study file (YAML); docs/study_reference.md lists its keys");
  [[nodiscard]] Study load() const { return load_study(file, overrides); }
  /// `-o`, or results/NAME below the working folder.
  [[nodiscard]] std::filesystem::path results_folder(const Study& study) const {
    return results.empty() ? std::filesystem::path("results") / study.name
                           : std::filesystem::path(results);
  }
};

/// A finite number within limits, both included; CLI::Range would let NaN pass.
[[nodiscard]] CLI::Validator finite_within(double low, double high);

/// `--memory` with units; refuses what is negative.
void add_memory_flag(CLI::App& verb, std::size_t& bytes);

/// Flags of verbs that work long.
struct WorkFlags {
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::size_t memory_bytes = std::size_t{1} << 30;
  bool quiet = false;

  void add_to(CLI::App& verb);
  /// All but --memory, for verbs that hold a frame at a time.
  void add_without_memory_to(CLI::App& verb);
};

/// `--view EX EY EZ TX TY TZ [VFOV]`: where pictures are drawn from.
struct ViewFlag {
  std::vector<double> numbers;

  void add_to(CLI::App& verb);
  /// None when the flag is not given. Throws Error when it says no view.
  [[nodiscard]] std::optional<sim::View> view() const;
};

/// `--format`: one of `formats`, of those that `formatted` knows.
void add_format_flag(CLI::App& verb, std::string& format,
                     const std::vector<std::string>& formats = {"text", "csv", "json"});
/// text (as wide as the terminal that it goes to), csv, json, markdown or tex.
[[nodiscard]] std::string formatted(const Table& table, const std::string& format);
/// A program for csv and json, a paper for markdown and tex.
[[nodiscard]] Reader reader_of(const std::string& format);

/// Adds a flag that takes several names, by commas or by repeating it; a comma within a name is
/// written \, and a name that is given twice counts once.
CLI::Option* add_list(CLI::App& verb, const char* flag, std::vector<std::string>& names,
                      const std::string& help);

/// `--interim`: an unfinished sweep is taken as far as it is.
void add_interim_flag(CLI::App& verb, bool& interim);

/// A file that a flag names, to be written when the work is done.
struct OutputFile {
  std::string flag;
  std::filesystem::path file;  ///< empty: not asked for
  std::string ending;          ///< that it must have, as ".ot"; empty: any
};

/// A file that a flag names, to be read.
struct InputFile {
  std::string flag;
  std::filesystem::path file;  ///< empty or not there: none
};

/// Refuses before the work what could not be written after it, or would take the place of what is
/// read: throws Error unless each file has its ending, lies in a folder that is there, is no folder
/// itself and none of `inputs`, and no two are the same.
void check_outputs(const std::vector<OutputFile>& outputs,
                   const std::vector<InputFile>& inputs = {});

/// Locks on the folders of files that belong together, so that two runs into one place leave the
/// files of one of them and never a mixture; waits for a run that holds one. Empty names and
/// folders that are not there are left out. Folders are locked in the order of their paths, so that
/// no two runs wait for each other.
[[nodiscard]] std::list<FolderLock> lock_outputs(const std::vector<std::filesystem::path>& files);

}  // namespace mapscore::eval
