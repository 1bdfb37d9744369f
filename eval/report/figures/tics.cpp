// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/tics.hpp"

#include "eval/report/figures/script.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace mapscore::eval {
namespace {

constexpr double kFont_pt = 6.5, kLine_in = 0.11, kOneLine_in = 0.16;
constexpr double kTurned = 0.57;  ///< sine of 35 degrees
constexpr double kShareOfPlace = 0.97;

/// Letters of the longest line.
std::size_t longest_line(const std::string& name) {
  std::size_t longest = 0, line = 0;
  for (const char letter : name) {
    line = letter == '\n' ? 0 : line + 1;
    longest = std::max(longest, line);
  }
  return longest;
}

double width_in(const std::vector<std::string>& names) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, longest_line(name));
  return text_width_in(longest, kFont_pt);
}

/// gnuplot takes a label of a tic with a `%` for a format of numbers.
std::string without_format(const std::string& name) {
  std::string doubled;
  for (const char letter : name) doubled.append(letter == '%' ? 2 : 1, letter);
  return doubled;
}

std::string setting_of(const std::vector<std::string>& names, const std::string& turn) {
  std::string tics;
  for (std::size_t i = 0; i < names.size(); ++i)
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_quoted(without_format(names[i])), i);
  return fmt::format("set xtics ({}) {} font ',{}'", tics, turn, kFont_pt);
}

}  // namespace

NameTics name_tics(const std::vector<std::string>& names, double place_in) {
  const double room_in = kShareOfPlace * place_in;
  if (width_in(names) <= room_in) return {setting_of(names, "norotate"), kOneLine_in};
  std::vector<std::string> broken = names;
  std::ptrdiff_t most_breaks = 0;
  for (std::string& name : broken) {
    std::replace(name.begin(), name.end(), ' ', '\n');
    most_breaks = std::max(most_breaks, std::count(name.begin(), name.end(), '\n'));
  }
  if (width_in(broken) <= room_in)
    return {setting_of(broken, "norotate"),
            kOneLine_in + kLine_in * static_cast<double>(most_breaks)};
  return {setting_of(names, "rotate by 35 right"), kLine_in + kTurned * width_in(names)};
}

}  // namespace mapscore::eval
