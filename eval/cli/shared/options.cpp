// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/options.hpp"

#include <fmt/format.h>

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

CLI::Validator finite_within(double low, double high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return fits ? std::string()
                    : fmt::format("{}: must be a number from {} to {}", text, low, high);
      },
      fmt::format("in [{} - {}]", low, high));
}

void add_memory_flag(CLI::App& verb, std::size_t& bytes) {
  const auto refuse_negative = [](const std::string& text) {
    return text.rfind('-', 0) == 0 ? text + ": must not be negative, e.g. 512MB" : std::string();
  };
  verb.add_option("--memory", bytes, "Decoded frames held at once, e.g. 512MB [1GiB]")
      ->transform(CLI::AsSizeValue(false))
      ->transform(CLI::Validator(refuse_negative, ""));  // the later one looks first
}

void WorkFlags::add_to(CLI::App& verb) {
  verb.add_option("-j,--jobs", jobs, "Worker threads [all cores]; never changes a result")
      ->check(CLI::Range(1, 1024));
  add_memory_flag(verb, memory_bytes);
  verb.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

}  // namespace mapscore::eval
