// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/sweep/sweep_flags.hpp"
#include "eval/results/sweep_status.hpp"
#include "eval/study/study.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace mapscore::eval {

/// What a sweep over a study takes, in text.
class SweepSize {
 public:
  /// `results`: whose last sweep measured a rate, if any did. Throws Error as read_status.
  SweepSize(const Study& study, const std::filesystem::path& results);

  [[nodiscard]] std::size_t trials() const;
  /// "5 cells x 3 methods x 6 seeds = 90 trials".
  [[nodiscard]] std::string grid() const;
  /// How long so many trials take, and by what rate; or that no rate is known.
  [[nodiscard]] std::string time_of(std::size_t trials) const;
  /// Throws Error, with count and time, when the study has very many trials; never with `yes`.
  void refuse_many(bool yes) const;

 private:
  std::size_t cells_, methods_, seeds_;
  std::optional<SweepStatus> last_;
};

/// `mapscore sweep --dry_run`: prints cells, trials, how many are there, how many the sweep would
/// compute and the time that these take, by its flags. Writes nothing. Throws Error as a sweep
/// does.
void print_dry_run(const Study& study, const std::filesystem::path& results,
                   const SweepFlags& flags);

}  // namespace mapscore::eval
