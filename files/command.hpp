// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mapscore {

class SupervisorServer;

/// How far another program may go.
struct CommandLimits {
  double timeout_s = std::numeric_limits<double>::infinity();
  std::uint64_t file_bytes = 0;  ///< of each file that it writes; 0: any number
  std::size_t kept_bytes = 0;    ///< of what it prints the first and the last so many; 0: all
  bool one_log = false;          ///< errors stand between the output, as on a terminal
  const SupervisorServer* server = nullptr;  ///< that starts it; without one this process does
  std::function<bool()> stop = {};           ///< asked about ten times a second
};

/// How another program ended.
struct CommandOutcome {
  int exit_code = 0;                        ///< 128 and its number where a signal ended it
  int signal = 0;                           ///< that ended it; 0: none
  std::string out, err;                     ///< what it printed
  bool timed_out = false, stopped = false;  ///< ended by the limits, whatever the exit code
  double wall_s = 0.0, processor_s = 0.0;   ///< the latter with its children
  std::uint64_t peak_bytes = 0;             ///< of memory, of the largest of its processes
};

/// Where a program lies on the PATH, an absolute path; nothing where it is not there.
[[nodiscard]] std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// Runs a program to its end, in `folder`, with an empty standard input, in a session of its own.
/// `words`: its name, searched on the PATH where it holds no slash, and its arguments, which no
/// shell reads. No process that it started outlives it, be it in a session of its own, nor this
/// process, however that ends. Throws Error when it cannot be started. Safe from several threads.
[[nodiscard]] CommandOutcome run_command(const std::vector<std::string>& words,
                                         const std::filesystem::path& folder,
                                         const CommandLimits& limits = {});

}  // namespace mapscore
