// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/csv_cells.hpp"

namespace mapscore::eval {
namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Takes a cell in quotes off the front of `rest`, up to the comma behind it.
std::optional<std::string> take_quoted(std::string_view& rest) {
  std::string cell;
  std::size_t at = rest.find('"') + 1;
  while (true) {
    const std::size_t quote = rest.find('"', at);
    if (quote == rest.npos) return std::nullopt;
    cell += rest.substr(at, quote - at);
    at = quote + 1;
    if (at >= rest.size() || rest[at] != '"') break;
    cell += '"';
    ++at;
  }
  const std::size_t comma = std::min(rest.find(',', at), rest.size());
  if (!trimmed(rest.substr(at, comma - at)).empty()) return std::nullopt;
  rest.remove_prefix(comma);
  return cell;
}

}  // namespace

std::optional<std::vector<std::string>> csv_cells(std::string_view line) {
  std::vector<std::string> cells;
  std::string_view rest = line;
  while (true) {
    const std::size_t first = rest.find_first_not_of(kBlanks);
    if (first != rest.npos && rest[first] == '"') {
      auto cell = take_quoted(rest);
      if (!cell) return std::nullopt;
      cells.push_back(std::move(*cell));
    } else {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      cells.emplace_back(trimmed(rest.substr(0, comma)));
      rest.remove_prefix(comma);
    }
    if (rest.empty()) return cells;
    rest.remove_prefix(1);  // the comma
  }
}

}  // namespace mapscore::eval
