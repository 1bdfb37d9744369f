// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/figure_flags.hpp"
#include "eval/cli/shared/live_status.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/shared/stop_signal.hpp"
#include "eval/cli/shared/truth_source.hpp"
#include "eval/cli/sweep/tolerance_search.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/render/study_recording.hpp"
#include "eval/report/figures/frontier_figure.hpp"
#include "eval/report/figures/tolerance_figure.hpp"
#include "eval/results/study_store.hpp"
#include "eval/score/lattice_check.hpp"
#include "eval/statistics/frontier.hpp"
#include "files/folder_lock.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace mapscore::eval {
namespace {

struct ToleranceFlags {
  StudyFlags study;
  WorkFlags work;
  ToleranceAim aim;
  ToleranceChoice choice;
  std::string reference, format = "text", figure;
  FigureFlags style;
  bool yes = false;
};

/// The method whose tolerances the others' are compared with: the first searched, if none is named.
std::string reference_method(const std::string& named, const std::vector<ToleranceRow>& rows) {
  if (named.empty()) return rows.front().method;
  if (std::ranges::find(rows, named, &ToleranceRow::method) == rows.end())
    throw Error("--reference " + named + ": is not among the methods that are searched");
  return named;
}

int tolerance(const ToleranceFlags& flags) {
  const FigureStyle style = flags.style.style();
  const Study study = study_of_only_scene(flags.study.load());
  const std::filesystem::path results = flags.study.results_folder(study);
  const Recording recording =
      shown_recording("tolerance", study, results, flags.work.jobs, flags.work.quiet);
  const ClassTable table = detected_table(study, recording.info().table);
  const ToleranceChoice choice = with_whole_paths(study, flags.choice);
  std::vector<ToleranceRow> rows = tolerance_searches(study, table, flags.aim, choice);
  const std::string reference = reference_method(flags.reference, rows);
  check_truth_size(study, recording, rows.size() * static_cast<std::size_t>(flags.aim.trials),
                   flags.yes);

  std::optional<FolderLock> lock;
  enter_results("tolerance", results, flags.work.quiet, lock);
  ResultStore store = ResultStore::open(results / "results.sqlite");
  const StopSignal stop;
  const SearchCost cost = search_tolerances(
      study, recording, table, flags.aim, choice, flags.work, store,
      [&] { return stop.taken() != 0; }, rows);
  if (cost.stopped) {
    std::cerr << fmt::format(
        "tolerance: stopped; {} trials were computed and are in {}; the same command goes on\n",
        cost.computed, shown(results / "results.sqlite"));
    return 128 + stop.taken();
  }
  if (!flags.work.quiet)
    std::cerr << fmt::format("tolerance {}: {} trials computed, {} already there; {}\n", study.name,
                             cost.computed, cost.reused, shown(results / "results.sqlite"));
  if (!cost.any_visible) std::cerr << "tolerance: note: " << LatticeCheck::kNothingVisible << '\n';
  if (!flags.figure.empty()) {
    const FolderLock figures(flags.figure);
    const std::string& against = choice.against;
    std::vector<ToleranceRow> drawn = rows;
    std::erase_if(drawn, [&](const ToleranceRow& row) { return row.path == against; });
    const FigureSheet sheet = against.empty() ? tolerance_figure(study, flags.aim, drawn, style)
                                              : frontier_figure(study, flags.aim, drawn, style);
    for (const auto& file : draw(sheet, flags.figure))
      std::cerr << "tolerance: " << shown(file) << '\n';
  }
  const Reader reader = reader_of(flags.format);
  std::cout << formatted(reader == Reader::paper
                             ? tolerance_matrix(study, flags.aim, rows)
                             : tolerance_table(study, flags.aim, reference, rows, reader),
                         flags.format);
  return 0;
}

void add_aim(CLI::App& verb, ToleranceFlags& flags) {
  verb.add_option("--metric", flags.aim.metric, "Score that falls with the dose [f1]");
  auto* target = verb.add_option("--target", flags.aim.target, "The score to keep")
                     ->check(finite_within(-1e9, 1e9));
  verb.add_option("--loss", flags.aim.loss,
                  "In place of a target: what the score of the least dose may lose, seed by seed "
                  "[0.05]")
      ->check(finite_within(0.0, 1e9))
      ->excludes(target);
  add_list(verb, "--fault", flags.choice.faults, "Swept paths or their ends, by commas [all]");
  add_list(verb, "--method", flags.choice.methods, "Methods, by commas [all]");
  verb.add_option("--reference", flags.reference,
                  "Method whose tolerances the others' are compared with, paired by seed [first]");
  verb.add_option(
      "--against", flags.choice.against,
      fmt::format("Swept path of a second fault, or its end: the tolerances under each of its "
                  "doses ({} over a range of two)",
                  kFrontierDoses));
  add_list(verb, "--group", flags.choice.groups,
           "pooled, macro, detected classes, by commas, or all of these [pooled]");
  verb.add_option(
          "--trials", flags.aim.trials,
          fmt::format("Trials of a search, without {} that settle a doubt [42]", kDoubtTrials))
      ->check(CLI::Range(kLeastTrials, 100000));
}

}  // namespace

void add_tolerance(CLI::App& program, int& exit_code) {
  auto* verb =
      program.add_subcommand("tolerance", "Find the largest dose of each fault that a score bears");
  const auto flags = std::make_shared<ToleranceFlags>();
  verb->callback([flags, &exit_code] { exit_code = tolerance(*flags); });
  flags->study.add_to(*verb);
  flags->work.add_to(*verb);
  add_yes_flag(*verb, flags->yes);
  add_aim(*verb, *flags);
  add_format_flag(*verb, flags->format, {"text", "csv", "json", "markdown", "tex"});
  verb->add_option("--figure", flags->figure,
                   "Folder for tolerance.png and .pdf (frontier.png with --against), with script "
                   "and numbers");
  flags->style.add_to(*verb);
  verb->footer(
      "Each swept path of the study is searched by itself, between its least and its greatest\n"
      "value, the others as the study has them. Trials go into the results folder and are never\n"
      "computed again; after Ctrl-C, which ends with 130, the same command goes on.\n"
      "docs/tolerance.md says how it searches.\n"
      "Examples:\n"
      "  mapscore tolerance configs/demo.yaml\n"
      "  mapscore tolerance configs/demo.yaml --target 0.8 --figure results/demo/figures\n"
      "  mapscore tolerance configs/tolerance.yaml --fault time_offset_ms --format csv\n"
      "  mapscore tolerance configs/demo.yaml --set "
      "sweep.faults.mount.magnitude_m=[0,0.1] --group all\n"
      "  mapscore tolerance configs/tolerance.yaml --fault misregistration.angle_deg "
      "--against pose.sigma_xy_m --figure FOLDER");
}

}  // namespace mapscore::eval
