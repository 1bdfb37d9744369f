// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/table.hpp"

#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/summary.hpp"
#include "eval/report/tidy_csv.hpp"

#include <iostream>

namespace mapscore::eval {
namespace {

struct TableFlags {
  std::string results, group{kPooled}, format = "text";
  bool tidy = false, interim = false;
};

void print_table(const TableFlags& flags) {
  const StudySummary summary = summarise_store(
      flags.results, {{flags.tidy ? std::string(kPooled) : flags.group}, flags.interim});
  if (flags.tidy) return write_tidy_csv(summary, std::cout);
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
  add_interim_flag(*verb, flags->interim);
  verb->footer(
      "Examples:\n"
      "  mapscore table results/demo\n"
      "  mapscore table results/demo --interim          while the sweep runs\n"
      "  mapscore table results/demo --class chair --format csv\n"
      "  mapscore table results/demo --tidy > demo.csv");
}

}  // namespace mapscore::eval
