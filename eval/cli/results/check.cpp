// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/cli/shared/options.hpp"
#include "eval/cli/verbs.hpp"
#include "eval/report/baseline.hpp"
#include "eval/results/build_identity.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>

namespace mapscore::eval {
namespace {

struct CheckFlags {
  std::string results, baseline;
  double allowed = 0.002;
  bool write = false, any_build = false;
};

/// Results that the code under test did not make say nothing of it.
void refuse_other_builds(const StudySummary& summary, const CheckFlags& flags) {
  if (summary.builds.size() > 1)
    throw Error(fmt::format("{}: its trials were made by {} builds; sweep again with one",
                            flags.results, summary.builds.size()));
  const std::string build = summary.builds.empty() ? "" : *summary.builds.begin();
  if (!flags.any_build && build != build_identity())
    throw Error(fmt::format(
        "{}: its trials were made by {}, this is build {}; sweep again with this program, or give "
        "--any_build",
        flags.results, build.empty() ? "a build that did not tell" : "build " + build,
        build_identity()));
}

int check(const CheckFlags& flags) {
  const StudySummary summary = summarise_store(flags.results);
  refuse_other_builds(summary, flags);
  const std::vector<BaselineRow> now = baseline_of(summary);
  if (flags.write) {
    write_baseline(now, flags.baseline);
    std::cout << fmt::format("{}: {} figures written\n", shown(flags.baseline), now.size());
    return 0;
  }
  const std::vector<BaselineRow> baseline = read_baseline(flags.baseline);
  const std::vector<Fall> fallen = falls(baseline, now, flags.allowed);
  if (fallen.empty()) {
    std::cout << fmt::format("{}: all {} figures hold (none fell by more than {})\n",
                             shown(flags.results), baseline.size(), flags.allowed);
    return 0;
  }
  std::cout << to_text(fall_table(fallen))
            << fmt::format("{}: {} of {} figures fell by more than {}\n", flags.results,
                           fallen.size(), baseline.size(), flags.allowed);
  return 1;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
  auto* verb = program.add_subcommand("check", "Exit 1 and say which figure fell below a baseline");
  const auto flags = std::make_shared<CheckFlags>();
  verb->add_option("RESULTS", flags->results, "Results folder, or its results.sqlite")->required();
  verb->add_option("--baseline", flags->baseline, "CSV: what,class,metric,value")->required();
  verb->add_option("--allow", flags->allowed, "How far a figure may fall, absolutely [0.002]")
      ->check(finite_within(0.0, 1.0));
  verb->add_flag("--write", flags->write, "Write the baseline from these results instead");
  verb->add_flag("--any_build", flags->any_build,
                 "Take results that another build of mapscore made");
  verb->footer(
      "Examples:\n"
      "  mapscore check results/gate --baseline results/baselines/gate.csv\n"
      "  mapscore check results/gate --baseline results/baselines/gate.csv --write");
  verb->callback([flags, &exit_code] { exit_code = check(*flags); });
}

}  // namespace mapscore::eval
