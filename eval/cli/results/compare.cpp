// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/comparison.hpp"

#include <iostream>

namespace mapscore::eval {
namespace {

struct CompareFlags {
  std::string results, before, after, format = "text";
  ComparisonQuestion question;
};

void print_comparison(const CompareFlags& flags) {
  const Reader reader = reader_of(flags.format);
  const bool of_results = !flags.before.empty() && !flags.after.empty() && flags.results.empty();
  const bool of_methods = flags.before.empty() && flags.after.empty() && !flags.question.b.empty();
  if (!of_results && !of_methods)
    throw Error("compare: give RESULTS A B, or --before RESULTS --after RESULTS");
  if (of_methods && flags.question.any_recording)
    throw Error("compare: --any_recording is for --before and --after; RESULTS have one recording");
  const auto summary = [&](const std::string& results) {
    return summarise_store(results, {.groups = {flags.question.group}, .failed_commands = true});
  };
  const Table table = of_results ? before_after_table(summary(flags.before), summary(flags.after),
                                                      flags.question, reader)
                                 : comparison_table(summary(flags.results), flags.question, reader);
  std::cout << formatted(table, flags.format);
}

}  // namespace

void add_compare(CLI::App& program) {
  const auto [verb, flags] = add_verb<CompareFlags>(
      program, "compare", "Compare two methods, or results before and after a change, seed by seed",
      print_comparison);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite");
  verb->add_option("A", flags->question.a, "Method; its figures minus B's are shown");
  verb->add_option("B", flags->question.b, "Method");
  verb->add_option("--before", flags->before, "Results of all methods before a change");
  verb->add_option("--after", flags->after,
                   "Results after it: on the same recording, with the same seed");
  verb->add_flag("--any_recording", flags->question.any_recording,
                 "Results before and after may be of two recordings, as two machines render one");
  add_list(*verb, "--metric", flags->question.metrics, "Figures, by commas [f1]");
  verb->add_option("--group", flags->question.group,
                   "pooled, macro, or the name of a detected class [pooled]");
  add_format_flag(*verb, flags->format, {"text", "csv", "json", "markdown", "tex"});
  verb->footer(
      "One row for each cell of the grid and metric: difference of the means over the seeds, its\n"
      "95 % interval, p by sign-flip permutation, and p corrected for the number of rows (Holm).\n"
      "csv and json have nine significant digits.\n"
      "Examples:\n"
      "  mapscore compare results/demo region_growing direct\n"
      "  mapscore compare results/demo erosion direct --metric precision,recall --group chair\n"
      "  mapscore compare results/demo erosion direct --metric f_2cm --format csv > erosion.csv\n"
      "  mapscore compare --before results/old --after results/new --metric f1 --format tex");
}

}  // namespace mapscore::eval
