// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/options.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Flags of `mapscore sweep`.
struct SweepFlags {
  StudyFlags study;
  WorkFlags work;
  bool jobs_given = false;
  std::string shard = "1/1";
  std::vector<std::string> merged;
  bool yes = false, dry_run = false, keep_builds = false, merge_only = false, slurm = false;
  bool retry_failed = false;
  std::optional<int> tasks;
  std::vector<std::string> sbatch_options;

  void add_to(CLI::App& verb);
  /// i and n of "i/n" with 1 <= i <= n. Throws Error on another text.
  [[nodiscard]] std::pair<int, int> shard_of() const;
  /// Throws Error on flags that do not go together, or that cannot be followed here.
  void check(const std::filesystem::path& results) const;
  /// The words of the same sweep from any folder, without its own flags of sharing out; with
  /// absolute paths.
  [[nodiscard]] std::vector<std::string> words(const std::filesystem::path& results,
                                               int jobs) const;
};

}  // namespace mapscore::eval
