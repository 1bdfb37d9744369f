// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/comparison.hpp"

#include <iostream>

namespace mapscore::eval {
namespace {

struct CompareFlags {
  std::string results, format = "text";
  ComparisonQuestion question;
};

void print_comparison(const CompareFlags& flags) {
  const Figures figures = flags.format == "text" ? Figures::rounded : Figures::nine_digits;
  std::cout << formatted(
      comparison_table(summarise_store(flags.results, {{flags.question.group}, false}),
                       flags.question, figures),
      flags.format);
}

}  // namespace

void add_compare(CLI::App& program) {
  const auto [verb, flags] = add_verb<CompareFlags>(
      program, "compare", "Compare two methods of a swept study, seed by seed", print_comparison);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("A", flags->question.a, "Method; its figures minus B's are shown")->required();
  verb->add_option("B", flags->question.b, "Method")->required();
  verb->add_option("--metric", flags->question.metrics,
                   "Figures, by commas or by repeating the flag [f1]")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--group", flags->question.group,
                   "pooled, macro, or the name of a detected class [pooled]");
  add_format_flag(*verb, flags->format);
  verb->footer(
      "One row for each cell of the grid and metric: difference of the means over the seeds, its\n"
      "95 % interval, p by sign-flip permutation, and p corrected for the number of rows (Holm).\n"
      "csv and json have nine significant digits.\n"
      "Examples:\n"
      "  mapscore compare results/demo region_growing direct\n"
      "  mapscore compare results/demo erosion direct --metric precision,recall --group chair\n"
      "  mapscore compare results/demo erosion direct --metric f_2cm --format csv > erosion.csv");
}

}  // namespace mapscore::eval
