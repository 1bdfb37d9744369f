// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/csv.hpp"

#include <algorithm>

namespace mapscore {
namespace {

constexpr std::string_view kCellBlanks = " \t";
constexpr std::string_view kRun = "=+-@";  ///< what a formula begins with
constexpr char kApostrophe = '\'';

/// Digits and signs alone: a number, a range of numbers, or the lone `-` of what is not defined.
bool is_numeric(std::string_view text) {
  return text.find_first_not_of("0123456789+-.eE") == text.npos;
}

bool needs_apostrophe(std::string_view text) {
  if (text.empty()) return false;
  if (text.front() == kApostrophe) return true;
  return kRun.find(text.front()) != kRun.npos && !is_numeric(text);
}

bool has_apostrophe(std::string_view cell) {
  return cell.size() > 1 && cell.front() == kApostrophe && needs_apostrophe(cell.substr(1));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kCellBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kCellBlanks) - first + 1);
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

std::string csv_cell(std::string_view text) {
  std::string cell(needs_apostrophe(text) ? 1 : 0, kApostrophe);
  cell += text;
  if (cell.find_first_of(",\"\r\n") == cell.npos && trimmed(cell).size() == cell.size())
    return cell;
  std::string quoted(1, '"');
  for (const char c : cell) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) (line += csv_cell(cell)) += ',';
  if (!line.empty()) line.pop_back();
  return line + '\n';
}

std::optional<std::vector<std::string>> csv_cells(std::string_view line, std::size_t most) {
  std::vector<std::string> cells;
  std::string_view rest = line;
  while (true) {
    const std::size_t first = rest.find_first_not_of(kCellBlanks);
    if (first != rest.npos && rest[first] == '"') {
      auto cell = take_quoted(rest);
      if (!cell) return std::nullopt;
      cells.push_back(std::move(*cell));
    } else {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      cells.emplace_back(trimmed(rest.substr(0, comma)));
      rest.remove_prefix(comma);
    }
    if (has_apostrophe(cells.back())) cells.back().erase(0, 1);
    if (rest.empty() || cells.size() > most) return cells;
    rest.remove_prefix(1);  // the comma
  }
}

}  // namespace mapscore
