// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/font.hpp"

#include "files/command.hpp"
#include "files/text.hpp"

#include <sstream>

namespace mapscore::eval {
namespace {

/// Fontconfig compares families without capitals and blanks.
std::string compared(const std::string& family) {
  std::string text = lower_case(family);
  std::erase(text, ' ');
  return text;
}

/// What fc-match says of a pattern; empty where it fails or is not there.
std::string matched_families(const std::string& pattern) {
  if (!program_on_path("fc-match")) return "";
  const CommandOutcome outcome = run_command({"fc-match", "-f", "%{family}", pattern}, "/");
  return outcome.exit_code == 0 ? outcome.out : "";
}

}  // namespace

std::optional<std::string> substitute_font(const std::string& family) {
  std::string pattern;  // in which a hyphen begins a size
  for (const char letter : family) pattern += letter == '-' ? "\\-" : std::string(1, letter);
  const std::string families = matched_families(pattern);
  std::istringstream names(families);
  for (std::string name; std::getline(names, name, ',');)
    if (compared(name) == compared(family)) return std::nullopt;
  return families.empty() ? std::nullopt : std::optional(families.substr(0, families.find(',')));
}

}  // namespace mapscore::eval
