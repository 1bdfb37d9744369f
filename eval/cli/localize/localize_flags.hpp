// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/shared/figure_flags.hpp"
#include "eval/recording/recording.hpp"
#include "eval/study/study.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Of --source: all that the recording has something for.
inline constexpr const char* kAllSources = "all";

/// What `mapscore localize` is asked for.
struct LocalizeFlags {
  std::string recording, output, source{word_of(PoseSource::particle_filter)};
  std::optional<std::string> grid, model;
  bool global_start = false;
  int seeds = 1;
  std::uint64_t seed = 1;
  std::vector<std::string> overrides;
  bool quiet = false;
  FigureFlags style;

  void add_to(CLI::App& verb);
};

/// Names of the sources that move a robot through a recording by its logs or a file; the others
/// move the truth.
[[nodiscard]] std::vector<std::string> localizing_sources();

/// A study of nothing but the localisation, with a lidar as one buys it.
[[nodiscard]] Study study_of(const LocalizeFlags& flags);

/// What is said of a source that is left out.
[[nodiscard]] std::string left_out(std::string_view source, std::string_view why);

/// The source of the flags, or all that the recording has something for, which may be none; `notes`
/// says of the others why they are left out.
[[nodiscard]] std::vector<std::string> chosen_sources(const LocalizeFlags& flags,
                                                      const Study& study,
                                                      const Recording& recording,
                                                      std::string& notes);

/// Throws Error for a flag, or a key of --set, that changes nothing for any of the sources.
void refuse_without_effect(const LocalizeFlags& flags, const Study& study,
                           const Recording& recording, const std::vector<std::string>& sources);

}  // namespace mapscore::eval
