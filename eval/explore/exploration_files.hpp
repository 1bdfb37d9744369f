// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/explore/exploration_result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Names of one exploration's files below its folder; docs/formats.md has what they hold.
inline constexpr const char *kRunFile = "run.yaml", *kCurveFile = "curve.csv",
                            *kViewsFile = "views.csv", *kWayFile = "way.csv",
                            *kMomentsFile = "moments.csv", *kFrontiersFile = "frontiers.csv",
                            *kMapFile = "map.ot", *kTimesFile = "times.csv";

/// Moments of which the floor is kept at most, at equal shares of the way; the last is the end.
inline constexpr std::size_t kKeptMoments = 4;

/// What run.yaml and curve.csv hold of a finished exploration.
struct KeptExploration {
  std::string key;  ///< of all that decides it
  std::string end, reason;
  double driven_m = 0.0, duration_s = 0.0;
  std::size_t views = 0, frames = 0, bump_contacts = 0;
  ExplorationCurve curve;
};

/// Writes all but map and recording, which are there already where they are kept, into a folder
/// that is there; run.yaml lists the hashes of them all. `floor(n)` of a moment is floor_N.yaml and
/// .pgm. The same result, the same bytes, but for times.csv, which is measured.
void write_exploration(const ExplorationResult& result, const std::string& key,
                       const std::filesystem::path& folder);

/// The key of a finished exploration; nothing where the folder holds none. Throws Error when its
/// run.yaml is damaged.
[[nodiscard]] std::optional<std::string> key_of_exploration(const std::filesystem::path& folder);

/// Nothing where the folder holds no finished exploration. Throws Error naming the file and the
/// folder to remove when one of its files is missing or not as it was written.
[[nodiscard]] std::optional<KeptExploration> read_exploration(const std::filesystem::path& folder);

/// Points of a figure's curve: comma-separated lines under the names of their columns.
[[nodiscard]] std::string curve_text(const ExplorationCurve& curve);
/// Throws Error naming the file and the line.
[[nodiscard]] ExplorationCurve curve_of_text(const std::string& text, const std::string& file);

}  // namespace mapscore::eval
