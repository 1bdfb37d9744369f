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

/// The name of a file without folder and extension; other texts as they are.
std::string stem_of(const std::string& value) {
  return value.find('/') == value.npos ? value : std::filesystem::path(value).stem().string();
}

/// How many characters from the last "_" on all names end in that are not their whole.
std::size_t common_ending(const std::set<std::string>& names) {
  const std::string& first = *names.begin();
  const std::size_t from = first.rfind('_');
  const auto ends_so = [&](const std::string& name) {
    return name.ends_with(first.substr(from)) && name.size() > first.size() - from;
  };
  return from != first.npos && std::ranges::all_of(names, ends_so) ? first.size() - from : 0;
}

/// Values as a figure names them: a file by its name without folder, extension and what all names
/// end in, where that tells all files of `among` apart.
std::vector<std::string> short_names(const std::vector<std::string>& values,
                                     const std::vector<std::string>& among) {
  const std::set<std::string> files(among.begin(), among.end());
  std::set<std::string> stems;
  for (const std::string& file : files) stems.insert(stem_of(file));
  if (stems.size() < files.size() || stems == files) return values;
  std::size_t dropped = 0;
  for (std::size_t more = 1; stems.size() > 1 && (more = common_ending(stems)) > 0;) {
    std::set<std::string> shorter;
    for (const std::string& stem : stems) shorter.insert(stem.substr(0, stem.size() - more));
    stems = std::move(shorter);
    dropped += more;
  }
  std::vector<std::string> names;
  for (const std::string& value : values) {
    names.push_back(stem_of(value));
    names.back().resize(names.back().size() - dropped);
  }
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
