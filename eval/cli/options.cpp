// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/options.hpp"

#include <algorithm>

namespace mapscore::eval {

void StudyFlags::add_to(CLI::App& verb) {
  verb.add_option("STUDY", file, "Study file (YAML); docs/study_reference.md lists its keys")
      ->required();
  verb.add_option("--set", overrides,
                  "Override a key: --set faults.pose.sigma_xy_m=0.02; may be repeated")
      ->allow_extra_args(false);
  verb.add_option("-o,--output", results, "Folder of the results [results/NAME]");
}

std::filesystem::path StudyFlags::results_folder(const Study& study) const {
  return results.empty() ? std::filesystem::path("results") / study.name
                         : std::filesystem::path(results);
}

void WorkFlags::add_to(CLI::App& verb) {
  verb.add_option("-j,--jobs", jobs, "Worker threads [all cores]; never changes a result")
      ->check(CLI::Range(1, 1024));
  verb.add_option("--memory", memory_bytes, "Decoded frames held at once, e.g. 512MB [1GiB]")
      ->transform(CLI::AsSizeValue(false));
  verb.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

}  // namespace mapscore::eval
