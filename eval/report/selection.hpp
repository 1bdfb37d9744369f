// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/summary.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Position in the sweep of a path, given as a whole or by its end where one alone ends so.
[[nodiscard]] std::optional<std::size_t> swept_axis(const Study& study, const std::string& name);
/// The value of a leaf as cells have it: 0.01 for 0.010. Throws as set_leaf.
[[nodiscard]] std::string canonical_value(Study study, const std::string& path,
                                          const std::string& value);
/// To suggest from what swept_axis takes.
[[nodiscard]] std::vector<std::string> swept_names(const Study& study);

/// What of a study is asked for. A swept path may be given by its end.
struct Selection {
  std::vector<std::string> where = {};    ///< path=value; several of one path: any of them
  std::vector<std::string> methods = {};  ///< none: all
};

/// The lines of a summary that a selection names. Throws Error, with what there is, for a path that
/// is not swept, a value that it does not have, an unknown method, and when no line is left.
[[nodiscard]] StudySummary selected(StudySummary summary, const Selection& selection);

}  // namespace mapscore::eval
