// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore {

/// How another program ended.
struct CommandOutcome {
  int exit_code = 0;     ///< 128 and its number where a signal ended it
  std::string out, err;  ///< what it printed
};

/// Where a program lies on the PATH; nothing where it is not there.
[[nodiscard]] std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// Runs a program of the PATH to its end, in `folder`, with an empty standard input. `words`: its
/// name and its arguments, which no shell reads. Throws Error when it cannot be started.
[[nodiscard]] CommandOutcome run_command(const std::vector<std::string>& words,
                                         const std::filesystem::path& folder);

}  // namespace mapscore
