// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

#include <CLI/CLI.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace mapscore::eval {

/// Flags that say which study, with what changed, and where its results go.
struct StudyFlags {
  std::string file;
  std::vector<std::string> overrides;  ///< path=value
  std::string results;

  void add_to(CLI::App& verb);
  [[nodiscard]] Study load() const { return load_study(file, overrides); }
  /// `-o`, or results/NAME below the working folder.
  [[nodiscard]] std::filesystem::path results_folder(const Study& study) const;
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
};

}  // namespace mapscore::eval
