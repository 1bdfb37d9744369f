// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/tables/pivot_table.hpp"
#include "eval/report/tables/tidy_csv.hpp"

#include <iostream>

namespace mapscore::eval {
namespace {

struct TableFlags {
  std::string results, format = "text";
  Selection selection;
  PivotQuestion question;
  bool tidy = false, interim = false;

  /// Neither figures nor places are asked for: the table of all scores.
  [[nodiscard]] bool is_plain() const {
    return question.rows.empty() && question.columns.empty() && question.metrics.empty() &&
           question.groups.size() < 2 && !question.spread;
  }
};

void print_table(const TableFlags& flags) {
  std::vector<std::string> groups = flags.question.groups;  // none: all
  if (groups.empty() && !places(flags.question, "class")) groups.emplace_back(kPooled);
  const StudySummary summary =
      selected(summarise_store(flags.results, {.groups = groups,
                                               .interim = flags.interim,
                                               .failed_commands = true,
                                               .pool_scenes = !flags.tidy}),
               flags.selection);
  if (flags.tidy) return write_tidy_csv(summary, std::cout);
  const Reader reader = reader_of(flags.format);
  std::cout << formatted(flags.is_plain() ? score_table(summary, groups.front(), reader)
                                          : pivot_table(summary, flags.question, reader),
                         flags.format);
}

void add_pivot(CLI::App& verb, TableFlags& flags) {
  verb.add_option("--where", flags.selection.where,
                  "Only at path=value of a swept path or of its end; may be repeated")
      ->allow_extra_args(false);
  add_list(verb, "--method", flags.selection.methods, "Only these methods, by commas [all]");
  auto* metric = add_list(verb, "--metric", flags.question.metrics,
                          "Figures, by commas, or counts of the accounting as frames_mapped, "
                          "map_voxels, images_lost [f1]");
  auto* rows =
      add_list(verb, "--rows", flags.question.rows,
               "What varies over the rows: swept paths (over ranges: point), method, class, "
               "metric, by commas "
               "[what is not in the columns]");
  auto* columns = add_list(verb, "--columns", flags.question.columns,
                           "What varies over the columns [what is not in the rows, or metric]");
  auto* spread = verb.add_flag("--spread", flags.question.spread,
                               "Low and high beside each figure (csv and json always have them)");
  verb.add_flag("--tidy", flags.tidy, "Everything as tidy CSV: a row a trial, class and metric")
      ->excludes(metric)
      ->excludes(rows)
      ->excludes(columns)
      ->excludes(spread)
      ->excludes("--class")
      ->excludes("--format");
}

}  // namespace

void add_table(CLI::App& program) {
  const auto [verb, flags] =
      add_verb<TableFlags>(program, "table", "Print the scores of a swept study", print_table);
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  add_list(*verb, "--class", flags->question.groups,
           "pooled, macro, or names of detected classes, by commas [pooled]");
  add_format_flag(*verb, flags->format, {"text", "csv", "json", "markdown", "tex"});
  add_pivot(*verb, *flags);
  add_interim_flag(*verb, flags->interim);
  verb->footer(
      "Text is as wide as the terminal: columns that do not fit follow below. In a file or a pipe\n"
      "it is as wide as it is. csv and json have nine significant digits; markdown and tex have\n"
      "the study's titles, and units.\n"
      "Examples:\n"
      "  mapscore table results/demo\n"
      "  mapscore table results/demo --interim          while the sweep runs\n"
      "  mapscore table results/demo --class chair --format csv\n"
      "  mapscore table results/demo --columns method --metric f1 --format tex > f1.tex\n"
      "  mapscore table results/demo --where magnitude_m=0.01 \\\n"
      "      --rows class --columns method,metric --metric precision,recall --format markdown\n"
      "  mapscore table results/demo --tidy > demo.csv");
}

}  // namespace mapscore::eval
