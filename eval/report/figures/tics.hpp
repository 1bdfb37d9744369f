// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace mapscore::eval {

/// Names along the x axis of a panel.
struct NameTics {
  std::string setting;     ///< `set xtics ...`
  double height_in = 0.0;  ///< of the labels, for FigureSheet::x_tics_in
};

/// The names at 0, 1, 2, ... of a panel, where each has `place_in` of its width: on one line where
/// all fit, or else broken between words, or else turned.
[[nodiscard]] NameTics name_tics(const std::vector<std::string>& names, double place_in);

}  // namespace mapscore::eval
