// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

#include <string>
#include <vector>

namespace mapscore::eval {

/// A swept leaf as a figure shows it, in the unit that people read.
struct FigureAxis {
  std::string name;                 ///< "misregistration", "N", or the key
  std::string unit;                 ///< "mm", "deg", or nothing
  bool numeric = true;              ///< all values are numbers
  std::vector<double> at;           ///< place of each value: itself in `unit`, or 0, 1, 2, ...
  std::vector<std::string> values;  ///< text of each value, in `unit`; names without underscores
  std::string key;                  ///< last part of the leaf's path, in the names of files

  /// "misregistration (mm)".
  [[nodiscard]] std::string title() const;
  /// "misregistration = 20 mm".
  [[nodiscard]] std::string text(std::size_t value) const;
  /// "20 mm".
  [[nodiscard]] std::string value_text(std::size_t value) const;
};

/// "particle_filter" as people write it: "particle filter".
[[nodiscard]] std::string spaced(std::string name);

/// Names at 0, 1, 2, ...
[[nodiscard]] FigureAxis axis_of_names(const std::string& name, std::vector<std::string> names);

/// The axis of these values of a field, as a study file writes them.
[[nodiscard]] FigureAxis figure_axis(const Field& field, const std::vector<std::string>& values);
/// The same for a swept leaf of a study; a file is named without folder and extension where that
/// tells all that are swept apart.
[[nodiscard]] FigureAxis figure_axis(const Study& study, const SweepAxis& axis);

}  // namespace mapscore::eval
