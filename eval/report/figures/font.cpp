// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/font.hpp"

#include "files/text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

namespace mapscore::eval {
namespace {

/// Fontconfig compares families without capitals and blanks.
std::string compared(const std::string& family) {
  std::string text = lower_case(family);
  std::erase(text, ' ');
  return text;
}

/// What a command says; empty where it fails.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "";
  std::string text;
  std::array<char, 256> part{};
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), read);
  return pclose(pipe) == 0 ? text : "";
}

}  // namespace

std::optional<std::string> substitute_font(const std::string& family) {
  std::string pattern;  // in which a hyphen begins a size
  for (const char letter : family) pattern += letter == '-' ? "\\-" : std::string(1, letter);
  const std::string families =
      output_of("fc-match -f '%{family}' " + shell_word(pattern) + " 2>/dev/null");
  std::istringstream names(families);
  for (std::string name; std::getline(names, name, ',');)
    if (compared(name) == compared(family)) return std::nullopt;
  return families.empty() ? std::nullopt : std::optional(families.substr(0, families.find(',')));
}

}  // namespace mapscore::eval
