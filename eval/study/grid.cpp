// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/grid.hpp"

#include "core/random_stream.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_set>
#include <utility>

namespace mapscore::eval {
namespace {

std::vector<Cell> product(const std::vector<SweepAxis>& sweep) {
  std::vector<Cell> grid{Cell{}};
  for (const SweepAxis& axis : sweep) {
    std::vector<Cell> finer;
    for (const Cell& cell : grid) {
      for (const std::string& value : axis.values) {
        finer.push_back(cell);
        finer.back().doses.emplace_back(axis.path, value);
      }
    }
    grid = std::move(finer);
  }
  return grid;
}

/// Rounded to a hundred-thousandth of the decade of the range.
std::string number_at(double unit, double low, double high) {
  const int digits = 5 - static_cast<int>(std::floor(std::log10(high - low)));
  const std::string rounded =
      fmt::format("{:.{}f}", low + unit * (high - low), std::clamp(digits, 0, 300));
  const double number = std::clamp(parse_real(rounded).value(), low, high);
  return fmt::format("{}", number == 0 ? 0 : number);
}

/// The value of a path at a place from 0 to 1; names and whole numbers have equal shares.
std::string value_at(double unit, const SweepAxis& axis, bool whole,
                     const std::optional<std::vector<double>>& numbers) {
  if (!numbers)
    return axis.values[static_cast<std::size_t>(unit * static_cast<double>(axis.values.size()))];
  const double low = numbers->at(0), high = numbers->at(1);
  if (!whole) return number_at(unit, low, high);
  return fmt::format("{:.0f}", low + std::floor(unit * (high - low + 1)));
}

/// Points that fall together stand once.
std::vector<Cell> sampled(const Study& study) {
  std::vector<bool> whole;
  std::vector<std::optional<std::vector<double>>> numbers;
  for (const SweepAxis& axis : study.sweep) {
    whole.push_back(is_whole_number(study, axis.path));
    numbers.push_back(numbers_of(axis));
  }
  std::vector<Cell> points;
  std::unordered_set<std::string> there;
  for (const auto& point : unit_points(study.sampling, study.sweep.size(), study.seed)) {
    Cell cell;
    std::string values;
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
      cell.doses.emplace_back(study.sweep[axis].path,
                              value_at(point[axis], study.sweep[axis], whole[axis], numbers[axis]));
      values += cell.doses.back().second + '\n';
    }
    if (there.insert(std::move(values)).second) points.push_back(std::move(cell));
  }
  return points;
}

}  // namespace

std::vector<Cell> cells(const Study& study) {
  const bool over_ranges = points_of(study.sampling) > 0 && !study.sweep.empty();
  std::vector<Cell> all = over_ranges ? sampled(study) : product(study.sweep);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].index = static_cast<int>(i);
  return all;
}

std::optional<std::vector<double>> numbers_of(const SweepAxis& axis) {
  std::vector<double> numbers;
  for (const std::string& value : axis.values) {
    const std::optional<double> number = parse_real(value);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

LazyList<TrialSpec> trials(const Study& study) {
  const auto grid = std::make_shared<const std::vector<Cell>>(cells(study));
  const std::vector<std::string> methods = method_names(study);
  const auto seeds = static_cast<std::size_t>(study.seeds);
  return {grid->size() * seeds * methods.size(), [grid, methods, seeds](std::size_t position) {
            const std::size_t seed = position / methods.size();
            return TrialSpec{static_cast<int>(position), methods[position % methods.size()],
                             (*grid)[seed / seeds], static_cast<int>(seed % seeds)};
          }};
}

std::uint64_t trial_seed(std::uint64_t study_seed, int seed_index) {
  return RandomStream(study_seed, "trial", {static_cast<std::uint64_t>(seed_index)}).bits();
}

Study resolve(const Study& study, const Cell& cell) {
  const std::string scene = scene_of(study, cell);
  Study resolved = scene.empty() ? study : with_scene(study, scene);
  resolved.sweep.clear();
  resolved.sampling = {};
  for (const auto& [path, value] : cell.doses)
    if (scene.empty() || path != kSceneAxis) set_dose(resolved, path, value);
  return resolved;
}

std::string scene_of(const Study& study, const Cell& cell) {
  for (const auto& [path, value] : cell.doses)
    if (!study.scenes.empty() && path == kSceneAxis) return value;
  return "";
}

decltype(Cell::doses) doses_of_scene(const Study& study, decltype(Cell::doses) doses) {
  if (!study.scenes.empty())
    std::erase_if(doses, [](const auto& dose) { return dose.first == kSceneAxis; });
  return doses;
}

std::string text_of(const Cell& cell) {
  std::string text;
  for (const auto& [path, value] : cell.doses)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", path, value);
  return text;
}

}  // namespace mapscore::eval
