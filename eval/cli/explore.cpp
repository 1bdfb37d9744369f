// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/cli/shared/figure_flags.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/shared/progress.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/explore/exploration_study.hpp"
#include "eval/explore/exploration_summary.hpp"
#include "eval/report/exploration/coverage_curves.hpp"
#include "eval/report/exploration/exploration_strip.hpp"
#include "eval/report/exploration/exploration_table.hpp"
#include "eval/report/exploration/floor_moments.hpp"
#include "eval/report/pictures/caption.hpp"
#include "eval/report/tables/table_formats.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

struct ExploreFlags {
  StudyFlags study;
  WorkFlags work;
  std::optional<int> seed;
  bool scores_only = false, figures = false;
  FigureFlags style;
  std::string format = "text";
};

/// How much of all explorations' budgets is used up, in metres: of one exploration the larger share
/// of its metres and of its seconds; one that has ended counts whole, and one that was there does
/// not count.
class ExploreDisplay {
 public:
  ExploreDisplay(const std::vector<PlannedExploration>& planned, bool quiet)
      : planned_(planned), used_m_(planned.size()), progress_("explore", "m", quiet) {
    for (const PlannedExploration& exploration : planned)
      budget_m_ += exploration.config.exploration.budget_m;
  }

  /// All have ended.
  void finish() {
    const auto budget = static_cast<std::int64_t>(budget_m_);
    progress_.show(budget, budget, "all of them ended");
  }

  void show(std::size_t position, const CoveragePoint& point, bool ended) {
    if (const int signal = stop_.taken())
      throw StoppedRecording(signal, "an exploration ran", "it");
    const ExplorationSettings& settings = planned_[position].config.exploration;
    const double share =
        std::max(point.driven_m / settings.budget_m, point.stamp_s / settings.budget_s);
    const std::scoped_lock lock(mutex_);
    if (ended && used_m_[position] == 0.0)
      budget_m_ -= settings.budget_m;
    else
      used_m_[position] = settings.budget_m * (ended ? 1.0 : std::min(share, 1.0));
    double all_m = 0.0;
    for (const double one_m : used_m_) all_m += one_m;
    progress_.show(static_cast<std::int64_t>(all_m), static_cast<std::int64_t>(budget_m_),
                   fmt::format("{}: {:.1f} m, {:.0f} % of the surface seen",
                               planned_[position].name, point.driven_m, 100.0 * point.coverage));
  }

 private:
  const std::vector<PlannedExploration>& planned_;
  StopSignal stop_;
  std::mutex mutex_;
  std::vector<double> used_m_;
  double budget_m_ = 0.0;
  Progress progress_;
};

std::vector<PlannedExploration> chosen(const Study& study, const ExploreFlags& flags) {
  std::vector<PlannedExploration> planned = explorations(study);
  if (!flags.seed) return planned;
  if (*flags.seed < 0 || *flags.seed >= study.seeds)
    throw Error(fmt::format("--seed: {} is none of the study; seeds: 0 to {}", *flags.seed,
                            study.seeds - 1));
  std::erase_if(planned,
                [&](const PlannedExploration& one) { return one.spec.seed_index != *flags.seed; });
  return planned;
}

void print_single(const FinishedExploration& run) {
  const KeptExploration& kept = run.kept;
  std::cout << fmt::format(
      "# {}: ended: {} ({}); {:.1f} m, {:.0f} s, {} views, {} frames, {} bumps\n", run.planned.name,
      kept.end, kept.reason, kept.driven_m, kept.duration_s, kept.views, kept.frames,
      kept.bump_contacts);
}

/// Curves of all, and for the first start of each group its moments and its film strip.
void draw_figures(const Study& study, const std::vector<ExplorationGroup>& groups,
                  const FigureStyle& style, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files = draw(exploration_curves(study, groups, style), folder);
  for (const ExplorationGroup& group : groups) {
    const FinishedExploration& run = *group.runs.front();
    const auto moments = draw(exploration_moments(run, style), folder);
    files.insert(files.end(), moments.begin(), moments.end());
    if (const auto strip = exploration_strip(run))
      files.push_back(write_picture(folder / ("strip_" + run.planned.name + ".png"), *strip));
  }
  for (const std::filesystem::path& file : files)
    if (file.extension() == ".png") std::cout << shown(file) << '\n';
}

/// Says how many explorations of the folder are not among those that are shown.
void note_others(const std::filesystem::path& folder,
                 const std::vector<FinishedExploration>& finished) {
  std::size_t others = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "runs"))
    if (std::filesystem::exists(entry.path() / kRunFile) &&
        std::ranges::find(finished, entry.path(), &FinishedExploration::folder) == finished.end())
      ++others;
  if (others > 0)
    std::cerr << fmt::format(
        "explore: note: {} holds {} more exploration{}, which the tables leave out\n",
        shown(folder / "runs"), others, others == 1 ? "" : "s");
}

void explore_study(const ExploreFlags& flags) {
  const FigureStyle style = flags.style.style();  // refused before the work
  const Study study = flags.study.load();
  const std::filesystem::path folder = flags.study.results_folder(study);
  const std::vector<PlannedExploration> planned = chosen(study, flags);
  std::vector<FinishedExploration> finished;
  {
    ExploreDisplay display(planned, flags.work.quiet);
    finished = explore_all(planned, {folder, flags.work.jobs, !flags.scores_only},
                           [&](std::size_t position, const CoveragePoint& point, bool ended) {
                             display.show(position, point, ended);
                           });
    display.finish();
  }
  note_others(folder, finished);
  const FolderLock lock(folder);
  write_whole_file(folder / "study.yaml", to_yaml(study));
  write_whole_file(folder / "exploration.csv", exploration_csv(finished));
  write_whole_file(folder / "runs.csv", runs_csv(finished));
  if (flags.format == "text")
    for (const FinishedExploration& run : finished) print_single(run);
  const std::vector<ExplorationGroup> groups = groups_of(finished);
  std::cout << formatted(exploration_table(study, groups, reader_of(flags.format)), flags.format);
  if (flags.figures) draw_figures(study, groups, style, folder / "figures");
  if (flags.format != "text") return;
  for (const char* file : {"exploration.csv", "runs.csv"})
    std::cout << shown(folder / file) << '\n';
}

}  // namespace

void add_explore(CLI::App& program) {
  const auto [verb, flags] = add_verb<ExploreFlags>(
      program, "explore", "The robot chooses its own way: drive, map, plan, record, score",
      explore_study);
  flags->study.add_to(*verb);
  verb->add_option("--seed", flags->seed, "Only the exploration of this seed's index [all]");
  verb->add_flag("--scores_only", flags->scores_only,
                 "Keep no recordings, which take a megabyte for ten frames and more");
  verb->add_flag(
      "--figures", flags->figures,
      "Draw curves, floors at up to four moments, and film strips where recordings are kept, "
      "below figures of the output folder");
  flags->style.add_to(*verb);
  flags->work.add_without_memory_to(*verb);
  add_format_flag(*verb, flags->format, {"text", "csv", "json", "markdown", "tex"});
  verb->footer(
      "Each exploration ends for a reason: explored, nothing_reachable or budget. Below the "
      "output\n"
      "folder runs/NAME holds its files, among them `recording`, which every verb takes, and\n"
      "map.ot. What is there already is not run again.\n"
      "Examples:\n"
      "  mapscore explore configs/explore.yaml --seed 0\n"
      "  mapscore explore configs/explore.yaml --set exploration.budget_s=300 -o results/short\n"
      "  mapscore explore configs/explore.yaml --scores_only --jobs 2\n"
      "  mapscore info results/explore/runs/home-next_best_view-seed0/recording");
}

}  // namespace mapscore::eval
