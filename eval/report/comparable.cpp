// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/comparable.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

namespace mapscore::eval {
namespace {

/// Leaves that decide no count of a common line. Detected classes are compared as they are.
constexpr std::array<std::string_view, 5> kFreeSettings{"name", "seed", "seeds", "detect",
                                                        "picture_view"};

std::vector<std::string> sorted_classes(const Baseline& baseline) {
  std::vector<std::string> names = detected_names(baseline.table);
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<std::string> differing_settings(const Study& before, const Study& after,
                                            bool same_recording) {
  const auto in_both = [&](const auto& has) { return has(before) && has(after); };
  const bool rendered = in_both([](const Study& study) { return !study.recording; });
  const auto is_free = [&](const std::string& path) {
    const std::string root = path.substr(0, path.find('.'));
    if (std::ranges::find(kFreeSettings, root) != kFreeSettings.end()) return true;
    if (decides_recording(root) && (same_recording || !rendered)) return true;
    const std::string method = root == "methods" ? path.substr(8, path.find('.', 8) - 8) : "";
    return (root == "methods" && !in_both([&](const Study& study) {
              return std::ranges::count(study.methods, method, &MethodSettings::name) > 0;
            })) ||
           in_both([&](const Study& study) {
             return std::ranges::count(study.sweep, path, &SweepAxis::path) > 0;
           });
  };
  std::map<std::string, std::array<std::string, 2>> settings;
  for (const auto& [path, value] : leaf_texts(without_titles(before))) settings[path][0] = value;
  for (const auto& [path, value] : leaf_texts(without_titles(after))) settings[path][1] = value;
  std::vector<std::string> differing;
  for (const auto& [path, values] : settings)
    if (!is_free(path) && values[0] != values[1])
      differing.push_back(fmt::format("{} {} -> {}", path, values[0].empty() ? "none" : values[0],
                                      values[1].empty() ? "none" : values[1]));
  return differing;
}

void check_one_build(const StudySummary& summary, const std::string& results) {
  if (summary.builds.size() != 1)
    throw Error(fmt::format("{}: its trials were made by {} builds; sweep again with one", results,
                            summary.builds.size()));
}

void check_comparable(const Baseline& before, const Baseline& after, bool any_recording) {
  const bool same_recording = before.recording_hash == after.recording_hash;
  std::vector<std::string> differing =
      differing_settings(before.study, after.study, same_recording);
  if (const auto then = sorted_classes(before), now = sorted_classes(after); then != now)
    differing.push_back(fmt::format("classes {} -> {}", fmt::join(then, " "), fmt::join(now, " ")));
  if (before.scoring_version != after.scoring_version)
    differing.push_back(
        fmt::format("scoring version {} -> {}", before.scoring_version, after.scoring_version));
  if (!same_recording && !any_recording)
    differing.push_back(fmt::format(
        "recording {} -> {}{} (--any_recording where both show the same)",
        before.recording_hash.substr(0, 8), after.recording_hash.substr(0, 8),
        before.study.seed == after.study.seed
            ? ""
            : fmt::format(" of seed {} -> {}, which the drive hangs on; --set recording=FOLDER "
                          "keeps the one",
                          before.study.seed, after.study.seed)));
  if (!differing.empty())
    throw Error(fmt::format("not comparable: {}", fmt::join(differing, ", ")));
}

}  // namespace mapscore::eval
