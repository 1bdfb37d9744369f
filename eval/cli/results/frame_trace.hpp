// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/pictures/judgement.hpp"
#include "eval/report/regression.hpp"
#include "eval/results/study_store.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Yields of all trials of the first seed of a results folder. Throws Error when the recording of
/// the results is not there, and as yields_of.
[[nodiscard]] std::vector<TrialYields> yields_of_store(const std::filesystem::path& results);

/// The trial of the first seed in whose line a figure lost most, run again by this program.
class TracedTrial {
 public:
  /// Throws Error when the recording of the results is not there.
  TracedTrial(const std::filesystem::path& results, const JudgedFigure& worst);

  /// The frames that lost most since a baseline; none where it does not tell.
  [[nodiscard]] std::optional<FrameTrace> trace(const Baseline& before) const;

  /// Writes what draw_pictures writes of the trial, with the classes alone that got worse, and
  /// frames.png: the frames that lost most, as contact_sheet shows them. Says on standard error
  /// where they are, or why there are none.
  void draw(const std::filesystem::path& folder, const std::optional<FrameTrace>& trace) const;

 private:
  void keep_classes(JudgedMap& map) const;

  StudyRecord record_;
  Recording recording_;
  JudgedFigure worst_;
  std::vector<std::string> classes_;  ///< of the figure
};

}  // namespace mapscore::eval
