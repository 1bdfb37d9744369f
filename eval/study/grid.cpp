// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/grid.hpp"

#include "core/random_stream.hpp"

#include <fmt/format.h>

#include <memory>

namespace mapscore::eval {

std::vector<Cell> cells(const Study& study) {
  std::vector<Cell> grid{Cell{}};
  for (const SweepAxis& axis : study.sweep) {
    std::vector<Cell> finer;
    for (const Cell& cell : grid) {
      for (const std::string& value : axis.values) {
        finer.push_back(cell);
        finer.back().doses.emplace_back(axis.path, value);
      }
    }
    grid = std::move(finer);
  }
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i].index = static_cast<int>(i);
  return grid;
}

LazyList<TrialSpec> trials(const Study& study) {
  const auto grid = std::make_shared<const std::vector<Cell>>(cells(study));
  std::vector<std::string> methods;
  for (const MethodSettings& method : study.methods) methods.push_back(method.name);
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
  Study resolved = study;
  resolved.sweep.clear();
  for (const auto& [path, value] : cell.doses) set_leaf(resolved, path, value);
  return resolved;
}

std::string text_of(const Cell& cell) {
  std::string text;
  for (const auto& [path, value] : cell.doses)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", path, value);
  return text;
}

}  // namespace mapscore::eval
