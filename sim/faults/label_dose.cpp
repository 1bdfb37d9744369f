// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/label_dose.hpp"

#include "core/error.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace mapscore::sim {
namespace {

/// Masks may be as large as the largest image; more would only cost memory.
constexpr double kWidest_px = 1000.0;

void demand(bool holds, const std::string& member, const std::string& problem) {
  if (!holds) throw Error("label fault " + member + ": " + problem);
}

void check_matrix(const std::vector<std::vector<double>>& matrix) {
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    const std::string name = "confusion_matrix, row " + std::to_string(row + 1);
    demand(matrix[row].size() == matrix.size(), name, "the matrix is not square; mend its length");
    double sum = 0.0;
    for (const double share : matrix[row]) {
      demand(share >= 0.0, name, "holds a share that is negative or no number; give 0 or more");
      sum += share;
    }
    demand(std::abs(sum - 1.0) < 1e-6, name, "does not add up to 1; mend its shares");
  }
}

}  // namespace

bool is_zero(const LabelDose& dose) {
  return keeps_masks(dose) && dose.confusion == 0.0 && dose.scores == 0.0 &&
         dose.confusion_matrix.empty();
}

bool keeps_masks(const LabelDose& dose) {
  return dose.boundary_px == 0.0 && dose.ragged_px == 0.0 && dose.miss == 0.0 &&
         dose.holes == 0.0 && dose.islands == 0.0;
}

void check(const LabelDose& d) {
  demand(std::abs(d.boundary_px) <= kWidest_px, "boundary_px", "give -1000 to 1000 pixels");
  for (const auto& [name, value] : {std::pair{"ragged_px", d.ragged_px},
                                    {"miss", d.miss},
                                    {"confusion", d.confusion},
                                    {"scores", d.scores},
                                    {"holes", d.holes},
                                    {"islands", d.islands}})
    demand(value >= 0.0 && value <= kWidest_px, name, "is no dose; give 0 (off) or more");
  for (const auto& [name, value] : {std::pair{"ragged_length_px", d.ragged_length_px},
                                    {"disc_radius_px", d.disc_radius_px},
                                    {"island_reach_px", d.island_reach_px}})
    demand(value >= 1.0 && value <= kWidest_px, name, "give 1 to 1000 pixels");
  demand(d.miss_area_px > 0.0 && std::isfinite(d.miss_area_px), "miss_area_px", "must be above 0");
  demand(!d.score_mean || (*d.score_mean >= 0.0 && *d.score_mean <= 1.0), "score_mean",
         "give 0 to 1");
  demand(d.score_concentration > 0.0 && std::isfinite(d.score_concentration), "score_concentration",
         "must be above 0");
  demand(d.confusion_matrix.empty() || d.confusion == 0.0, "confusion",
         "stands beside a confusion_matrix; keep one of the two");
  check_matrix(d.confusion_matrix);
}

LabelDose label_preset(LabelPreset preset) {
  LabelDose dose;
  if (preset == LabelPreset::ideal) return dose;
  dose.ragged_px = 1.5;
  dose.miss = 0.5;
  dose.confusion = 0.05;
  dose.scores = 1.0;
  dose.holes = 0.01;
  dose.islands = 0.005;
  return dose;
}

}  // namespace mapscore::sim
