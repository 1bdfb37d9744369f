// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace mapscore::eval {

/// What a sweep says of itself in status.json of its results folder, while it runs and when it has
/// ended (docs/formats.md).
struct SweepStatus {
  std::string study;
  std::string who;                            ///< PID@HOST
  std::int64_t started_s = 0, updated_s = 0;  ///< seconds since 1970, UTC
  std::string state = "running";              ///< or finished, stopped; a killed one stays running
  std::string shard = "1/1";
  int jobs = 1;
  std::int64_t missing = 0;                             ///< trials that it had to compute
  std::int64_t computed = 0, failed = 0;                ///< of these
  std::int64_t evaluations = 0, evaluations_total = 0;  ///< trials by frames
  double seconds = 0;                                   ///< of computing
  /// The last rate that a sweep of this folder has measured, and by how many jobs; 0 for none.
  double seconds_per_trial = 0;
  int rate_jobs = 0;

  /// Seconds until it is done, at its own rate; nothing before the first frame.
  [[nodiscard]] std::optional<double> seconds_left() const;
};

/// PID@HOST of this process.
[[nodiscard]] std::string this_process();

/// Aside and renamed, so that a reader finds it whole. Throws Error when it cannot be written.
void write_status(const SweepStatus& status, const std::filesystem::path& results);

/// Nothing where no sweep has written one. Throws Error when it is not what write_status writes.
[[nodiscard]] std::optional<SweepStatus> read_status(const std::filesystem::path& results);

}  // namespace mapscore::eval
