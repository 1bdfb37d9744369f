// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/figure_flags.hpp"

#include "eval/report/figures/font.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <iostream>

namespace mapscore::eval {

void FigureFlags::add_to(CLI::App& verb) {
  CLI::Option* flags[] = {
      verb.add_option("--width_mm", style_.width_mm,
                      "Width of every figure in print, 60 to 400 [as its panels need]"),
      verb.add_option("--font", font_, fmt::format("Font of the figures [{}]", style_.font)),
      verb.add_flag("--no_caption", no_caption_, "Nothing below the legend"),
      verb.add_flag("--grey", style_.grey, "No colours; line styles, marks and patterns instead")};
  for (CLI::Option* flag : flags) {
    flag->group("Figures");
    for (const char* name : {"--figure", "--figures"})
      if (auto* figure = verb.get_option_no_throw(name)) flag->needs(figure);
  }
  if (auto* interim = verb.get_option_no_throw("--interim"))
    verb.get_option("--no_caption")->excludes(interim);  // which the caption tells
}

FigureStyle FigureFlags::style() const {
  FigureStyle style = style_;
  style.font = font_.value_or(style.font);
  style.caption = !no_caption_;
  style.check();
  if (const auto other = font_ ? substitute_font(*font_) : std::nullopt)
    std::cerr << "mapscore: --font " << *font_ << " is not installed: PNG and PDF have "
              << shown(*other) << ", an SVG what its reader has\n";
  return style;
}

}  // namespace mapscore::eval
