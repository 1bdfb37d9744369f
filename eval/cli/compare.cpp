// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/verbs.hpp"
#include "eval/report/comparison.hpp"

#include <iostream>
#include <memory>

namespace mapscore::eval {
namespace {

struct CompareFlags {
  std::string results, format = "text";
  ComparisonQuestion question;
};

void print_comparison(const CompareFlags& flags) {
  const Table table = comparison_table(summarise_store(flags.results), flags.question);
  std::cout << (flags.format == "csv"    ? to_csv(table)
                : flags.format == "json" ? to_json(table)
                                         : to_text(table));
}

}  // namespace

void add_compare(CLI::App& program) {
  auto* verb =
      program.add_subcommand("compare", "Compare two methods of a swept study, seed by seed");
  const auto flags = std::make_shared<CompareFlags>();
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("A", flags->question.a, "Method; its figures minus B's are shown")->required();
  verb->add_option("B", flags->question.b, "Method")->required();
  verb->add_option("--metric", flags->question.metrics,
                   "Figures, by commas or by repeating the flag [f1]")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--group", flags->question.group,
                   "pooled, macro, or the name of a detected class [pooled]");
  verb->add_option("--format", flags->format, "text, csv or json [text]")
      ->check(CLI::IsMember({"text", "csv", "json"}));
  verb->footer(
      "One row for each cell of the grid and metric: difference of the means over the seeds, its\n"
      "95 % interval, p by sign-flip permutation, and p corrected for the number of rows (Holm).\n"
      "Examples:\n"
      "  mapscore compare results/demo region_growing direct\n"
      "  mapscore compare results/demo erosion direct --metric precision,recall --group chair\n"
      "  mapscore compare results/demo erosion direct --metric f_2cm --format csv > erosion.csv");
  verb->callback([flags] { print_comparison(*flags); });
}

}  // namespace mapscore::eval
