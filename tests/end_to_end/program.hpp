// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::testing {

/// How a run of a program ended, and what it said.
struct Outcome {
  int exit_code = -1;  ///< -1 when a signal ended it
  std::string out, err;
};

/// Circumstances of a run.
struct Surroundings {
  std::optional<std::size_t>
      file_size_limit;                    ///< writing a file beyond it fails, as on a full disk
  std::filesystem::path standard_output;  ///< in place of being captured
};

/// A program under way.
class Process {
 public:
  explicit Process(const std::vector<std::string>& command, const Surroundings& surroundings = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Ends it as a power cut would (SIGKILL) and waits for it. False when it had ended by itself.
  bool kill();
  /// Ctrl-C.
  void interrupt();
  [[nodiscard]] bool ended();
  [[nodiscard]] Outcome wait();

 private:
  pid_t id_ = -1;
  int status_ = 0;
  bool reaped_ = false;
  std::filesystem::path out_, err_;
};

/// Runs `mapscore` with these arguments to its end.
[[nodiscard]] Outcome mapscore(const std::vector<std::string>& arguments,
                               const Surroundings& surroundings = {});

/// The whole command line of `mapscore` with these arguments.
[[nodiscard]] std::vector<std::string> mapscore_command(const std::vector<std::string>& arguments);

/// Fails unless the program ended with 0.
void expect_done(const Outcome& outcome);

/// Fails unless the program ended with exit code 2 and one line on standard error that holds all of
/// `parts`.
void expect_refused(const Outcome& outcome, const std::vector<std::string>& parts);

/// The bytes of a file; empty when there is none.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// Every file and folder below `folder`, relative to it, in order.
[[nodiscard]] std::vector<std::string> contents_of(const std::filesystem::path& folder);

}  // namespace mapscore::testing
