// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/figures/style.hpp"

#include "core/error.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace mapscore::eval {
namespace {

constexpr double kMillimetresPerInch = 25.4, kNarrowest_mm = 60.0, kWidest_mm = 400.0;
/// Width of all panels of a figure that fills a page of the screen.
constexpr double kPanels_in = 6.6;
constexpr std::array<std::string_view, 4> kTones{"#000000", "#808080", "#404040", "#606060"};
constexpr std::array<std::string_view, 8> kGreyDashes{
    "1",         "(14,4)",         "(10,3,2,3)", "(2,1.5)",
    "(8,3,4,3)", "(14,3,2,2,2,3)", "(20,3,6,3)", "(8,2,3,2,3,2)"};
/// gnuplot's patterns: solid, none, hatched, hatched the other way, crossed, and denser ones.
constexpr std::array<int, 8> kPatterns{3, 0, 4, 5, 1, 2, 6, 7};
/// Hatched and crossed alone.
constexpr std::array<int, 6> kBandPatterns{4, 5, 6, 7, 1, 2};

}  // namespace

void FigureStyle::check() const {
  if (width_mm && !(*width_mm >= kNarrowest_mm && *width_mm <= kWidest_mm))
    throw Error(fmt::format("--width_mm {:g}: must be from {:g} to {:g}; a column is about 85",
                            *width_mm, kNarrowest_mm, kWidest_mm));
  if (!is_word(font, " -._") || font.front() == ' ' || font.front() == '-')
    throw Error("--font " + excerpt(font) +
                ": must be a font's name, of letters, digits, spaces and -._ alone, e.g. "
                "\"DejaVu Serif\"");
}

double FigureStyle::page_in() const {
  return *width_mm / kMillimetresPerInch - kLeft_in - kRight_in;
}

int FigureStyle::columns(int asked, double least_in, double gap_in) const {
  if (!width_mm) return asked;
  const int fitting = static_cast<int>((page_in() + gap_in) / (least_in + gap_in));
  const int rows = (asked + std::max(1, fitting) - 1) / std::max(1, fitting);
  return (asked + rows - 1) / rows;
}

double FigureStyle::panel_width_in(int asked, double least_in, double gap_in) const {
  if (!width_mm) return std::clamp(kPanels_in / asked, 1.5, 3.3);
  const int fitting = columns(asked, least_in, gap_in);
  return (page_in() - (fitting - 1) * gap_in) / fitting;
}

std::string grey_tone(std::size_t n) {
  return std::string(kTones[n % kTones.size()]);
}

std::string grey_dash(std::size_t n) {
  return std::string(kGreyDashes[n % kGreyDashes.size()]);
}

std::string bar_fill(std::size_t n, const FigureStyle& style) {
  return style.grey
             ? fmt::format("fs pattern {} border lc rgb '#000000'", kPatterns[n % kPatterns.size()])
             : "fs solid 0.85 noborder";
}

std::string band_fill(std::size_t n, const std::string& colour, const FigureStyle& style) {
  if (!style.grey) return fmt::format("fc rgb '{}' fs transparent solid 0.2 noborder", colour);
  return fmt::format("fc rgb '#AAAAAA' fs transparent pattern {} noborder",
                     kBandPatterns[n % kBandPatterns.size()]);
}

std::string greyed(std::string script) {
  constexpr std::string_view kBefore = "rgb '#";
  constexpr std::size_t kDigits = 6;
  for (std::size_t at = script.find(kBefore); at != script.npos; at = script.find(kBefore, at)) {
    at += kBefore.size();
    const auto part = [&](std::size_t n) {
      return std::stoi(script.substr(at + 2 * n, 2), nullptr, 16);
    };
    const auto luma =
        static_cast<int>(std::lround(0.299 * part(0) + 0.587 * part(1) + 0.114 * part(2)));
    script.replace(at, kDigits, fmt::format("{0:02X}{0:02X}{0:02X}", luma));
  }
  return script;
}

}  // namespace mapscore::eval
