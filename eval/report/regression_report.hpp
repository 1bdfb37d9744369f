// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/regression.hpp"
#include "eval/report/tables/table.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// Formats of regression_report.
inline const std::vector<std::string> kReportFormats{"text",  "csv",    "json",
                                                     "junit", "github", "markdown"};

/// A judgement for people and for CI; `results` names what was judged.
///   text, markdown  what got worse, then what got better, worst first: a row for each method,
///                   metric and class, with its worst cell; above more than five rows of what got
///                   worse, a row for each class; both verdicts in the last line
///   csv, json       every figure of every cell
///   junit           a test case for each method, metric and class
///   github          workflow commands: an error for each row of text, a notice for what got better
/// Throws Error for another format.
[[nodiscard]] std::string regression_report(const Judgement& judgement, const std::string& results,
                                            const std::string& format);

/// Why nothing was compared, for formats whose readers see standard output alone: an annotation
/// (github), a test case with an error (junit); empty for others.
[[nodiscard]] std::string refusal_report(const std::string& reason, const std::string& results,
                                         const std::string& format);

}  // namespace mapscore::eval
