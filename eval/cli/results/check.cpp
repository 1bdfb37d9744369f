// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/results/frame_trace.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/comparable.hpp"
#include "eval/report/regression_report.hpp"
#include "eval/results/build_identity.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace mapscore::eval {
namespace {

constexpr int kFell = 1, kNothingCompared = 3;

struct CheckFlags {
  std::string results, baseline, pictures, format = "text";
  std::vector<std::string> allowed, metrics{"precision", "recall", "f1", "iou", "f1_t1", "f_2cm"};
  bool update = false, frames = false, any_build = false, any_recording = false;
};

/// Results that the code under test did not make say nothing of it.
void refuse_other_builds(const StudySummary& summary, const CheckFlags& flags) {
  check_one_build(summary, flags.results);
  const std::string& build = *summary.builds.begin();
  if (!flags.any_build && build != build_identity())
    throw Error(fmt::format(
        "{}: its trials were made by {}, this is build {}; sweep again with this program, or give "
        "--any_build",
        flags.results, build.empty() ? "a build that did not tell" : "build " + build,
        build_identity()));
}

/// Those of --metric that the baseline has. Throws Error for one that no baseline tells.
std::vector<std::string> metrics_in(const Baseline& baseline, const CheckFlags& flags) {
  const std::vector<std::string> known = voxel_metrics(baseline);
  std::vector<std::string> metrics;
  const std::vector<std::string> usual = CheckFlags{}.metrics;
  for (const std::string& metric : flags.metrics) {
    if (std::ranges::find(known, metric) != known.end())
      metrics.push_back(metric);
    else if (std::ranges::find(usual, metric) == usual.end())
      require_one_of(known, metric, fmt::format("--metric {}: not in the baseline", metric));
  }
  return metrics;
}

/// Throws Error for a class or metric that the baseline does not have.
void check_tolerances(const Tolerances& tolerances, const Baseline& baseline) {
  std::vector<std::string> groups = detected_names(baseline.table);
  groups.insert(groups.end(), {std::string(kPooled), std::string(kMacro)});
  const std::vector<std::string> metrics = voxel_metrics(baseline);
  const auto require = [](const std::string& name, const std::vector<std::string>& known) {
    if (!name.empty())
      require_one_of(known, name, fmt::format("--allow: '{}' is not in the baseline", name));
  };
  for (const auto& [name, value] : tolerances.special) {
    require(name.first, groups);
    require(name.second, metrics);
  }
}

/// The frames that lost most, and pictures of them where they are asked for. What cannot be traced
/// changes no verdict.
std::optional<FrameTrace> trace_of(const Baseline& baseline, const Judgement& judgement,
                                   const CheckFlags& flags) try {
  const JudgedFigure* worst = judgement.worst();
  if (!worst) return std::nullopt;
  std::optional<FrameTrace> trace = trace_frames(flags.results, baseline, *worst);
  if (!flags.pictures.empty()) draw_fallen(flags.results, *worst, trace, flags.pictures);
  return trace;
} catch (const Error& error) {
  std::cerr << "check: frames are not traced: " << shown(error.what()) << '\n';
  return std::nullopt;
}

/// Prints how the results stand to the baseline and gives the exit code.
int report(const Baseline& baseline, const Baseline& now, const Tolerances& allowed,
           const CheckFlags& flags) {
  check_tolerances(allowed, baseline);
  Judgement judgement =
      judge(baseline, now, metrics_in(baseline, flags), allowed, flags.any_recording);
  judgement.trace = trace_of(baseline, judgement, flags);
  std::cout << regression_report(judgement, flags.results, flags.format);
  if (!judgement.compared()) return kNothingCompared;
  return judgement.fell() ? kFell : 0;
}

/// Prints what it changes, where the old baseline compares, also on another recording, and writes
/// the new one; says what the old one differed in.
void update(Baseline now, const Tolerances& allowed, CheckFlags flags) {
  flags.any_recording = true;
  std::string note;
  bool frames = flags.frames;
  if (std::filesystem::exists(flags.baseline)) try {
      const Baseline old = read_baseline(flags.baseline);
      frames = frames || !old.yields.empty();
      if (old.recording_hash != now.recording_hash)
        note = fmt::format("; the old one: recording {} -> {}", old.recording_hash.substr(0, 8),
                           now.recording_hash.substr(0, 8));
      static_cast<void>(report(old, now, allowed, flags));
    } catch (const Error& error) {
      note += fmt::format("; the old one: {}", shown(error.what()));
    }
  if (frames) now.yields = yields_of_store(flags.results);
  write_baseline(now, flags.baseline);
  std::cerr << fmt::format("check: {} written{}\n", shown(flags.baseline), note);
}

int check(const CheckFlags& flags) try {
  const Tolerances allowed = parse_tolerances(flags.allowed);
  const StudySummary summary = summarise_store(flags.results);
  refuse_other_builds(summary, flags);
  const Baseline now = baseline_of(summary);
  if (!flags.update) return report(read_baseline(flags.baseline), now, allowed, flags);
  update(now, allowed, flags);
  return 0;
} catch (const Error& error) {
  std::cout << refusal_report(error.what(), flags.results, flags.format);
  throw;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
  auto* verb = program.add_subcommand("check", "Exit 1 and say what got worse than a baseline");
  const auto flags = std::make_shared<CheckFlags>();
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("--baseline", flags->baseline, "File that --update wrote")->required();
  verb->add_option("--allow", flags->allowed,
                   "How much worse a figure may get, absolutely: NUMBER, METRIC=NUMBER or "
                   "CLASS/METRIC=NUMBER, by repeating the flag [0.002]")
      ->allow_extra_args(false);
  add_list(*verb, "--metric", flags->metrics,
           "Figures, by commas [precision,recall,f1,iou,f1_t1,f_2cm]");
  add_format_flag(*verb, flags->format, kReportFormats);
  verb->add_flag("--update", flags->update,
                 "Write the baseline from these results, after what that changes");
  verb->add_flag(
          "--frames", flags->frames,
          "With --update: keep what each frame gives, so that a fall is traced to frames; also "
          "where the old baseline has it")
      ->needs("--update");
  verb->add_option("--pictures", flags->pictures,
                   "Folder for pictures of the trial that lost most: its map, and the frames");
  verb->add_flag("--any_build", flags->any_build,
                 "Take results that another build of mapscore made");
  verb->add_flag("--any_recording", flags->any_recording,
                 "Compare with results on another recording, as another machine renders it; always "
                 "with --update");
  verb->footer(
      "Exit codes: 0 nothing got worse, 1 something did, 2 not comparable or wrong input, 3 "
      "nothing\n"
      "could be compared (other seeds than the baseline's, and fewer than 10).\n"
      "Examples:\n"
      "  mapscore check results/gate --baseline results/baselines/gate.json\n"
      "  mapscore check results/gate --baseline gate.json --allow 0.005 --allow chair/f1=0.02\n"
      "  mapscore check results/gate --baseline gate.json --format junit > check.xml\n"
      "  mapscore check results/gate --baseline gate.json --update");
  verb->callback([flags, &exit_code] { exit_code = check(*flags); });
}

}  // namespace mapscore::eval
