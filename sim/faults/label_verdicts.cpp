// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "core/random_stream.hpp"
#include "sim/faults/label_noise.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mapscore::sim {
namespace {

/// Gamma(shape), scale 1: G. Marsaglia and W. W. Tsang, A simple method for generating gamma
/// variables (2000); below shape 1 by their boost.
double gamma_draw(double shape, RandomStream& stream) {
  if (shape < 1.0) {
    const double boost = std::pow(1.0 - stream.uniform(), 1.0 / shape);
    return boost * gamma_draw(shape + 1.0, stream);
  }
  const double d = shape - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  while (true) {
    const double x = stream.normal(), root = 1.0 + c * x;
    const double u = 1.0 - stream.uniform();
    if (root <= 0.0) continue;
    const double v = root * root * root;
    if (std::log(u) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v;
  }
}

/// Beta(a, b), a and b at least 0 and not both 0.
double beta_draw(double a, double b, RandomStream& stream) {
  if (b == 0.0) return 1.0;
  if (a == 0.0) return 0.0;
  const double x = gamma_draw(a, stream), y = gamma_draw(b, stream);
  return x + y > 0.0 ? x / (x + y) : a / (a + b);
}

/// Chances of each class being named in place of a detected one.
class Confusion {
 public:
  Confusion(const ClassTable& table, const LabelDose& dose) {
    for (const SemanticClass& one : table.classes)
      if (one.detect) classes_.push_back(one.id);
    const std::size_t count = classes_.size();
    matrix_ = dose.confusion_matrix;
    if (!matrix_.empty() && matrix_.size() != count)
      throw Error("label fault confusion_matrix: has " + std::to_string(matrix_.size()) +
                  " rows for " + std::to_string(count) +
                  " detected classes; write a row and a column for each, in their order");
    if (matrix_.empty()) spread_evenly(count < 2 ? 0.0 : std::min(1.0, dose.confusion), count);
  }

  [[nodiscard]] double right(ClassId id) const { return matrix_[row_of(id)][row_of(id)]; }

  /// The class that is named in place of `id`: a wrong one when `first` < 1 - right(id), so that a
  /// greater dose adds errors to those of a lesser one; which, follows from `second`. Both uniform
  /// in [0, 1).
  [[nodiscard]] ClassId named(ClassId id, double first, double second) const {
    const std::size_t own = row_of(id);
    const double wrong = 1.0 - matrix_[own][own];
    if (first >= wrong) return id;
    double left = second * wrong;
    ClassId last = id;
    for (std::size_t column = 0; column < classes_.size(); ++column) {
      if (column == own || matrix_[own][column] == 0.0) continue;
      last = classes_[column];
      left -= matrix_[own][column];
      if (left < 0.0) break;
    }
    return last;
  }

 private:
  void spread_evenly(double wrong, std::size_t count) {
    const double each = wrong / std::max(1.0, static_cast<double>(count) - 1.0);
    matrix_.assign(count, std::vector<double>(count, each));
    for (std::size_t row = 0; row < count; ++row) matrix_[row][row] = 1.0 - wrong;
  }
  [[nodiscard]] std::size_t row_of(ClassId id) const {
    return static_cast<std::size_t>(std::ranges::find(classes_, id) - classes_.begin());
  }

  std::vector<ClassId> classes_;
  std::vector<std::vector<double>> matrix_;
};

/// Chance that the score of a right class (`is_right`), or of a wrong one, is blind: drawn without
/// regard to whether the class is right. `right`: the chance of a right class.
double blind_chance(bool is_right, double right, double mean) {
  if (is_right) return right > mean ? (right - mean) / (right * (1.0 - mean)) : 0.0;
  return right < mean ? (mean - right) / (mean * (1.0 - right)) : 0.0;
}

}  // namespace

void corrupt_verdicts(std::vector<Detection>& detections, const ClassTable& table,
                      const LabelDose& dose, std::uint64_t seed, int frame) {
  check(dose);
  const Confusion confusion(table, dose);
  const auto frame_index = static_cast<std::uint64_t>(frame);
  for (Detection& detection : detections) {
    const ClassId truth = detection.class_id;
    RandomStream of_class(seed, "labels.class", {frame_index, detection.instance});
    const double first = of_class.uniform(), second = of_class.uniform();
    detection.class_id = confusion.named(truth, first, second);
    if (dose.scores == 0.0) continue;
    const double chance = confusion.right(truth), mean = dose.score_mean.value_or(chance);
    const double a = dose.score_concentration * mean, b = dose.score_concentration - a;
    const bool right = detection.class_id == truth;
    RandomStream of_blind(seed, "labels.blind", {frame_index, detection.instance});
    const double tells = of_blind.uniform() < blind_chance(right, chance, mean) ? 0.0 : 1.0;
    RandomStream of_score(seed, "labels.score", {frame_index, detection.instance});
    const double score = beta_draw(a + (right ? tells : 0.0), b + (right ? 0.0 : tells), of_score);
    detection.score = 1.0 - std::min(1.0, dose.scores) * (1.0 - score);
  }
}

}  // namespace mapscore::sim
