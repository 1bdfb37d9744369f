// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/table.hpp"

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/tidy_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

namespace mapscore::eval {
namespace {

struct TableFlags {
  std::string results, group{kPooled}, format = "text";
  bool tidy = false;
};

void print_table(const TableFlags& flags) {
  const StudySummary summary = summarise_store(flags.results);
  if (flags.tidy) return write_tidy_csv(summary, std::cout);
  const std::vector<std::string> groups = summary.groups();
  if (std::find(groups.begin(), groups.end(), flags.group) == groups.end())
    throw Error(fmt::format("--class {}: not scored in this study; there are: {}", flags.group,
                            fmt::join(groups, ", ")));
  std::cout << formatted(score_table(summary, flags.group), flags.format);
}

}  // namespace

void add_table(CLI::App& program) {
  const auto [verb, flags] =
      add_verb<TableFlags>(program, "table", "Print the scores of a swept study", print_table);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("--class", flags->group,
                   "pooled, macro, or the name of a detected class [pooled]");
  add_format_flag(*verb, flags->format);
  verb->add_flag("--tidy", flags->tidy, "Everything as tidy CSV: a row a trial, class and metric");
  verb->footer(
      "Examples:\n"
      "  mapscore table results/demo\n"
      "  mapscore table results/demo --class chair --format csv\n"
      "  mapscore table results/demo --tidy > demo.csv");
}

}  // namespace mapscore::eval
