// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/font.hpp"

#include "files/command.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

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

/// First and last letters of fonts, as fc-list prints them: "20-7e a0".
using Letters = std::vector<std::pair<char32_t, char32_t>>;

bool has(const Letters& letters, char32_t code) {
  return std::ranges::any_of(
      letters, [code](const auto& range) { return range.first <= code && code <= range.second; });
}

/// Letters of all installed fonts of colours or without; empty where fc-list is not there.
Letters installed_letters(const char* pattern) {
  Letters letters;
  if (!program_on_path("fc-list")) return letters;
  std::istringstream ranges(run_command({"fc-list", "-f", "%{charset} ", pattern}, "/").out);
  for (std::string range; ranges >> range;) {
    char* rest = nullptr;
    const auto first = static_cast<char32_t>(std::strtoul(range.c_str(), &rest, 16));
    letters.emplace_back(
        first, *rest == '-' ? static_cast<char32_t>(std::strtoul(rest + 1, nullptr, 16)) : first);
  }
  return letters;
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

std::string drawable(std::string script) {
  constexpr std::string_view kAsEmoji = "\xef\xb8\x8f";
  constexpr char32_t kPlaneEnd = 0x10000, kFirstEmoji = 0x2300;
  for (std::size_t at = script.find(kAsEmoji); at != script.npos; at = script.find(kAsEmoji, at))
    script.erase(at, kAsEmoji.size());
  if (std::ranges::all_of(script, [](unsigned char byte) { return byte < 0x80; })) return script;
  const Letters plain = installed_letters(":color=false"), emoji = installed_letters(":color=true");
  const auto keep = [&](char32_t code) {
    if (code < 0x80 || plain.empty()) return code < kPlaneEnd;
    return code < kPlaneEnd && has(plain, code) && (code < kFirstEmoji || !has(emoji, code));
  };
  return with_signs(script, keep, "?");
}

}  // namespace mapscore::eval
