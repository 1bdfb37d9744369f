// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/grid.hpp"

#include <fmt/format.h>

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

std::vector<TrialSpec> trials(const Study& study) {
  std::vector<TrialSpec> result;
  for (const Cell& cell : cells(study)) {
    for (int seed_index = 0; seed_index < study.seeds; ++seed_index) {
      for (const MethodSettings& method : study.methods) {
        result.push_back({static_cast<int>(result.size()), method.name, cell, seed_index});
      }
    }
  }
  return result;
}

Study resolve(const Study& study, const Cell& cell) {
  Study resolved = study;
  resolved.sweep.clear();
  for (const auto& [path, value] : cell.doses) set_leaf(resolved, path, value);
  return resolved;
}

std::string text_of(const Cell& cell) {
  std::string text;
  for (const auto& [path, value] : cell.doses) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", path, value);
  }
  return text;
}

}  // namespace mapscore::eval
