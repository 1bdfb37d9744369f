// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/suggestion.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>

namespace mapscore {
namespace {

namespace fs = std::filesystem;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

/// By how many letters a misspelt word may differ.
std::size_t most_edits(std::string_view word) {
  return std::max<std::size_t>(1, std::min<std::size_t>(3, word.size() / 3));
}

/// The name in a folder that is nearest to `name`; empty where none is near.
std::string nearest_name(const fs::path& folder, const std::string& name) {
  std::string nearest;
  std::size_t least = most_edits(name) + 1;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    const std::string other = entry.path().filename().string();
    const std::size_t distance = edit_distance(name, other);
    if (distance > least || (distance == least && (nearest.empty() || other > nearest))) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

std::vector<std::string> ending_in(std::string_view name, const std::vector<std::string>& paths) {
  std::vector<std::string> found;
  std::ranges::copy_if(paths, std::back_inserter(found), [&](const std::string& path) {
    return path.ends_with("." + std::string(name));
  });
  return found;
}

}  // namespace

std::optional<std::string> path_named(std::string_view name,
                                      const std::vector<std::string>& paths) {
  if (std::ranges::find(paths, name) != paths.end()) return std::string(name);
  const std::vector<std::string> ending = ending_in(name, paths);
  return ending.size() == 1 ? std::optional(ending.front()) : std::nullopt;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& choices) {
  // Most often the unit is what is missing: a choice that continues the word is the nearest of all.
  const auto distance = [&](const std::string& choice) {
    return choice.starts_with(std::string(word) + "_") ? 0 : edit_distance(word, choice);
  };
  if (const auto ending = ending_in(word, choices); ending.size() > 1)
    return fmt::format("write one of {}", fmt::join(ending, ", "));
  const auto nearest = std::ranges::min_element(choices, {}, distance);
  if (nearest == choices.end()) return "remove it";
  if (distance(*nearest) <= most_edits(word)) return fmt::format("did you mean '{}'?", *nearest);
  return fmt::format("write one of {}", fmt::join(choices, ", "));
}

void require_one_of(const std::vector<std::string>& choices, std::string_view word,
                    std::string_view problem) {
  if (std::ranges::find(choices, word) == choices.end())
    throw Error(fmt::format("{}; {}", problem, suggestion(word, choices)));
}

std::string path_suggestion(const fs::path& missing, std::string_view otherwise) {
  fs::path there;
  for (const fs::path& part : missing) {
    std::error_code unreadable;
    if (fs::exists(there / part, unreadable)) {
      there /= part;
      continue;
    }
    const std::string near = nearest_name(there.empty() ? "." : there, part.string());
    if (!near.empty()) return fmt::format("did you mean '{}'?", (there / near).string());
    break;
  }
  return std::string(otherwise);
}

}  // namespace mapscore
