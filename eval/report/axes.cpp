// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/axes.hpp"

#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

namespace mapscore::eval {
namespace {

/// "mount error (mm)" -> "mount error", "mm".
std::pair<std::string, std::string> name_and_unit(std::string_view title) {
  const std::size_t bracket = title.rfind(" (");
  if (bracket == title.npos || !title.ends_with(')')) return {std::string(title), ""};
  return {std::string(title.substr(0, bracket)),
          std::string(title.substr(bracket + 2, title.size() - bracket - 3))};
}

/// Of a key in metres that a figure shows in millimetres; else 1.
double scale_of(std::string_view key, std::string_view unit) {
  return unit == "mm" && key.ends_with("_m") ? 1000.0 : 1.0;
}

/// Values as a figure names them: a file by its name without folder and extension, where that tells
/// all files of `among` apart.
std::vector<std::string> short_names(const std::vector<std::string>& values,
                                     const std::vector<std::string>& among) {
  const auto stem = [](const std::string& value) {
    return value.find('/') == value.npos ? value : std::filesystem::path(value).stem().string();
  };
  std::set<std::string> files(among.begin(), among.end()), stems;
  for (const std::string& file : files) stems.insert(stem(file));
  std::vector<std::string> names = values;
  if (stems.size() == files.size()) std::ranges::transform(names, names.begin(), stem);
  return names;
}

}  // namespace

std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string FigureAxis::title() const {
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string FigureAxis::text(std::size_t value) const {
  return fmt::format("{} = {}", name, value_text(value));
}

std::string FigureAxis::value_text(std::size_t value) const {
  return fmt::format("{}{}{}", values.at(value), unit.empty() ? "" : " ", unit);
}

FigureAxis axis_of_names(const std::string& name, std::vector<std::string> names) {
  FigureAxis axis{name, "", false, {}, std::move(names), name};
  for (std::size_t n = 0; n < axis.values.size(); ++n) axis.at.push_back(static_cast<double>(n));
  return axis;
}

FigureAxis figure_axis(const Field& field, const std::vector<std::string>& values) {
  FigureAxis figure;
  std::tie(figure.name, figure.unit) =
      name_and_unit(field.figure.empty() ? field.key : field.figure);
  figure.key = field.key;
  const double scale = scale_of(field.key, figure.unit);
  for (const std::string& value : values) {
    const std::optional<double> number = parse_real(value);
    figure.numeric = figure.numeric && number;
    figure.at.push_back(number.value_or(0.0) * scale);
    figure.values.push_back(number ? fmt::format("{:.6g}", *number * scale) : spaced(value));
  }
  if (!figure.numeric) figure.at = axis_of_names("", figure.values).at;
  return figure;
}

FigureAxis figure_axis(const Study& study, const SweepAxis& axis) {
  const auto swept = std::ranges::find(study.sweep, axis.path, &SweepAxis::path);
  return figure_axis(field_of(study, axis.path),
                     short_names(axis.values, (swept == study.sweep.end() ? axis : *swept).values));
}

}  // namespace mapscore::eval
