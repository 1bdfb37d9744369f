// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/faults/image_doses.hpp"

#include "core/error.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace mapscore::sim {
namespace {

/// Masks may be as large as the largest image; more would only cost memory.
constexpr double kWidest_px = 1000.0;

void demand(bool holds, const std::string& member, const std::string& problem) {
  if (!holds) throw Error(member + ": " + problem);
}

void check_matrix(const std::vector<std::vector<double>>& matrix) {
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    const std::string name = "confusion_matrix, row " + std::to_string(row + 1);
    demand(matrix[row].size() == matrix.size(), name, "the matrix is not square; mend its length");
    double sum = 0.0;
    for (const double share : matrix[row]) {
      demand(share >= 0.0, name,
             "holds, times `scale`, a share that is negative or no number; give 0 or more, or a "
             "lesser scale");
      sum += share;
    }
    demand(std::abs(sum - 1.0) < 1e-6, name, "does not add up to 1; mend its shares");
  }
}

/// Its shares off the diagonal times `factor`; the diagonal takes the rest of 1.
std::vector<std::vector<double>> scaled(std::vector<std::vector<double>> matrix, double factor) {
  if (factor == 1.0) return matrix;
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    double wrong = 0.0;
    for (std::size_t column = 0; column < matrix[row].size(); ++column)
      if (column != row) wrong += matrix[row][column] *= factor;
    if (row < matrix[row].size()) matrix[row][row] = 1.0 - wrong;
  }
  return matrix;
}

}  // namespace

bool is_zero(const DepthDose& dose) {
  bool zero = true;
  DepthDose::fields(dose, [&](const auto& member, const Field& field) {
    if constexpr (std::same_as<decltype(member), const double&>)
      zero = zero && (!field.dose || member == 0.0);
  });
  return zero;
}

void check(const DepthDose& d) try {
  check_ranges(d);
  if (!(d.grazing_from_deg.deg < d.grazing_to_deg.deg))
    throw Error("grazing_from_deg: is not below grazing_to_deg; give a lesser angle");
  if (!(d.range_min_m < d.range_max_m))
    throw Error("range_min_m: is not below range_max_m; give a lesser number");
} catch (const Error& error) {
  throw Error(std::string("depth fault ") + error.what());
}

DepthDose DepthDose::of(DepthPreset preset) {
  DepthDose dose;
  if (preset == DepthPreset::ideal) return dose;
  fields(dose, [](auto& member, const Field& field) {
    if constexpr (std::same_as<decltype(member), double&>)
      if (field.dose) member = 1.0;
  });
  if (preset == DepthPreset::kinect_v1) {
    dose.range_min_m = 0.8;
    dose.range_max_m = 4.0;
  }
  return dose;
}

bool is_zero(const LabelDose& dose) {
  return keeps_masks(dose) && dose.confusion == 0.0 && dose.scores == 0.0 &&
         dose.confusion_matrix.empty();
}

bool keeps_masks(const LabelDose& dose) {
  return dose.boundary_px == 0.0 && dose.ragged_px == 0.0 && dose.miss == 0.0 &&
         dose.holes == 0.0 && dose.islands == 0.0;
}

LabelDose masks_alone(LabelDose dose) {
  const LabelDose ideal;
  dose.confusion = ideal.confusion;
  dose.confusion_matrix = ideal.confusion_matrix;
  dose.scores = ideal.scores;
  dose.score_mean = ideal.score_mean;
  dose.score_concentration = ideal.score_concentration;
  return dose;
}

void check(const LabelDose& d) try {
  check_ranges(d);
  if (d.boundary_px > kWidest_px) throw Error("boundary_px: give -1000 to 1000 pixels");
  if (d.ragged_px > kWidest_px) throw Error("ragged_px: give up to 1000 pixels");
  if (!d.confusion_matrix.empty() && d.confusion != 0.0)
    throw Error("confusion: stands beside a confusion_matrix; keep one of the two");
  check_matrix(d.confusion_matrix);
} catch (const Error& error) {
  throw Error(std::string("label fault ") + error.what());
}

void LabelDose::scale_by(double factor) {
  scale_doses(*this, factor);
  if (confusion_matrix.empty()) return;
  confusion = 0.0;
  if (factor > 0.0)
    confusion_matrix = scaled(std::move(confusion_matrix), factor);
  else
    confusion_matrix.clear();
}

LabelDose LabelDose::of(LabelPreset preset) {
  if (preset == LabelPreset::ideal) return {};
  return {.ragged_px = 1.5,
          .miss = 0.5,
          .confusion = 0.05,
          .scores = 1.0,
          .holes = 0.01,
          .islands = 0.005};
}

}  // namespace mapscore::sim
