// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibration_certainty.hpp"

#include "core/calibration/weakest_direction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cstddef>
#include <optional>

namespace mapscore {
namespace {

using Numbers = CalibrationCorrection::Vector;
using NumberMatrix = CalibrationCorrection::Matrix;

constexpr double kDifference = 0.4;          // of sigma
constexpr double kOwn = 0.4, kCommon = 0.5;  // parts of the covariance, measured
constexpr double kLeastError =
    0.04;  // of sigma: what all outlines have in common, such as the cut of pixels

/// Of the numbers that are looked for; the others stay as they are.
NumberMatrix of_free(const NumberMatrix& A, const Numbers& free) {
  NumberMatrix H = A.cwiseProduct(free * free.transpose());
  for (int n = 0; n < CalibrationCorrection::kNumbers; ++n) H(n, n) += 1 - free[n];
  return H;
}

/// Gradient and normal matrix of what errs together, or of a frame.
struct ObjectEquations {
  Numbers gradient = Numbers::Zero();
  NumberMatrix normal = NumberMatrix::Zero();
  void add(const ObjectEquations& other) {
    gradient += other.gradient;
    normal += other.normal;
  }
};

std::vector<ObjectEquations> by_object(const OutlineEvidence& frame,
                                       const CalibrationCorrection& at, float sigma_px) {
  std::vector<ObjectEquations> objects(frame.objects() + 1);
  frame.linearise(at, sigma_px, 1, [&](const OutlineEquation& e) {
    const double pull = e.weight * e.residual;
    objects[e.object].gradient += pull * e.slope;
    objects[e.object].normal.selfadjointView<Eigen::Lower>().rankUpdate(e.slope, e.weight);
  });
  for (ObjectEquations& object : objects) {
    const NumberMatrix both = object.normal.selfadjointView<Eigen::Lower>();
    object.normal = both;
  }
  return objects;
}

/// By frame and object, a number of its outline: that of an earlier frame's object whose outline is
/// the same, else a new one. What lies on no object is new in each frame.
std::vector<std::vector<std::size_t>> outline_numbers(const std::deque<OutlineEvidence>& frames) {
  std::vector<std::vector<std::size_t>> numbers;
  std::size_t count = 0;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    std::vector<std::optional<std::size_t>> known(frames[n].objects() + 1);
    for (std::size_t before = n; before-- > 0;) {
      const std::vector<std::size_t> same = frames[n].repeated_in(frames[before]);
      for (std::size_t object = 0; object < known.size(); ++object)
        if (!known[object] && same[object] > 0) known[object] = numbers[before][same[object]];
    }
    std::vector<std::size_t>& own = numbers.emplace_back();
    for (const auto& number : known) own.push_back(number ? *number : count++);
  }
  return numbers;
}

/// The equations of all frames, and their sums.
struct PooledEquations {
  std::vector<ObjectEquations> frames, outlines;
  NumberMatrix normal = NumberMatrix::Zero();
};

PooledEquations pooled(const std::deque<OutlineEvidence>& frames, const CalibrationCorrection& at,
                       float sigma_px) {
  PooledEquations pool;
  const std::vector<std::vector<std::size_t>> numbers = outline_numbers(frames);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const std::vector<ObjectEquations> objects = by_object(frames[n], at, sigma_px);
    ObjectEquations& whole = pool.frames.emplace_back();
    for (std::size_t object = 0; object < objects.size(); ++object) {
      const std::size_t number = numbers[n][object];
      if (number >= pool.outlines.size()) pool.outlines.resize(number + 1);
      pool.outlines[number].add(objects[object]);
      whole.add(objects[object]);
    }
    pool.normal += whole.normal;
  }
  return pool;
}

Numbers gradient_of(const std::deque<OutlineEvidence>& frames, const CalibrationCorrection& at,
                    float sigma_px) {
  Numbers sum = Numbers::Zero();
  for (const OutlineEvidence& frame : frames)
    frame.linearise(at, sigma_px, 1, [&](const OutlineEquation& e) {
      const double pull = e.weight * e.residual;
      sum += pull * e.slope;
    });
  return sum;
}

NumberMatrix derivative_of(const std::deque<OutlineEvidence>& frames,
                           const CalibrationCorrection& at, float sigma_px, const Numbers& free,
                           const Numbers& pixels) {
  NumberMatrix A = NumberMatrix::Zero();
  for (int n = 0; n < CalibrationCorrection::kNumbers; ++n) {
    if (free[n] == 0) continue;
    const double step = kDifference * static_cast<double>(sigma_px) / pixels[n];
    Numbers by = Numbers::Zero();
    by[n] = step;
    const Numbers above = gradient_of(frames, at.changed(by), sigma_px);
    by[n] = -step;
    const Numbers below = gradient_of(frames, at.changed(by), sigma_px);
    A.col(n) = (above - below) / (2 * step);
  }
  return A;
}

/// First-order changes of an estimate, from its equations.
class EstimateChanges {
 public:
  EstimateChanges(const PooledEquations& pool, const NumberMatrix& derivative, const Numbers& free)
      : free_(free),
        normal_(of_free(pool.normal, free)),
        normal_lu_(normal_),
        derivative_lu_(of_free(derivative, free)) {}

  /// Without some of the equations.
  [[nodiscard]] Numbers without(const ObjectEquations& some) const {
    const Numbers gradient = free_.cwiseProduct(some.gradient);
    const NumberMatrix others = normal_ - some.normal.cwiseProduct(free_ * free_.transpose());
    const Numbers change = others.partialPivLu().solve(gradient);
    const Numbers pull = normal_ * change;
    return derivative_lu_.solve(pull);
  }
  /// H^-1 N of some of the equations: what part of all that is known they tell.
  [[nodiscard]] NumberMatrix leverage(const ObjectEquations& some) const {
    const NumberMatrix own = some.normal.cwiseProduct(free_ * free_.transpose());
    return normal_lu_.solve(own);
  }
  /// g^T H^-1 g.
  [[nodiscard]] double square(const ObjectEquations& some) const {
    const Numbers gradient = free_.cwiseProduct(some.gradient);
    const Numbers solved = normal_lu_.solve(gradient);
    return gradient.dot(solved);
  }
  /// A^-1 H A^-T: the covariance where each equation has an error of its own, of variance 1.
  [[nodiscard]] NumberMatrix unit_covariance() const {
    const NumberMatrix known = normal_.cwiseProduct(free_ * free_.transpose());
    const NumberMatrix half = derivative_lu_.solve(known);
    const NumberMatrix turned = half.transpose();
    const NumberMatrix whole = derivative_lu_.solve(turned);
    return whole;
  }

 private:
  Numbers free_;
  NumberMatrix normal_;
  Eigen::PartialPivLU<NumberMatrix> normal_lu_, derivative_lu_;
};

/// Covariance without its floor, and how many outlines there are.
void measure_errors(const PooledEquations& pool, const EstimateChanges& changes, double sought,
                    CalibrationCertainty& certainty) {
  NumberMatrix own = NumberMatrix::Zero();
  double known = 0, overlap = 0, squares = 0, error = 0;
  for (const ObjectEquations& outline : pool.outlines) {
    const NumberMatrix leverage = changes.leverage(outline);
    if (!(leverage.trace() > 0)) continue;
    known += leverage.trace();
    squares += leverage.trace() * leverage.trace();
    overlap += leverage.cwiseProduct(leverage.transpose()).sum();
    error += changes.square(outline);
    const Numbers change = changes.without(outline);
    own += change * change.transpose();
  }
  const double variance = error / (known - overlap);
  certainty.objects = squares > 0 ? known * known / squares : 0.0;
  const double few = sought / std::max(certainty.objects, 1.0);
  certainty.covariance = kOwn * own + kCommon * few * variance * changes.unit_covariance();
}

}  // namespace

CalibrationCertainty certainty_of(const std::deque<OutlineEvidence>& frames,
                                  const CalibrationCorrection& correction, float sigma_px,
                                  const Numbers& free, const Numbers& pixels) {
  CalibrationCertainty certainty;
  PooledEquations pool = pooled(frames, correction, sigma_px);
  NumberMatrix derivative = derivative_of(frames, correction, sigma_px, free, pixels);
  // What the start tells of the masks' size counts, as in the fit: where all pixels have a mask,
  // all outlines are borders of two, which say nothing of it, and nothing else would. Of the other
  // numbers it is left out: edges alone are to tell them.
  constexpr int kSize = CalibrationCorrection::kMaskSize;
  const double size_information = start_information(sigma_px)[kSize];
  pool.normal(kSize, kSize) += size_information, derivative(kSize, kSize) += size_information;
  const EstimateChanges changes(pool, derivative, free);
  measure_errors(pool, changes, free.sum(), certainty);
  const double least_px = kLeastError * static_cast<double>(sigma_px);
  for (int n = 0; n < CalibrationCorrection::kNumbers; ++n)
    certainty.covariance(n, n) += free[n] * least_px * least_px / (pixels[n] * pixels[n]);
  double spread = 0;
  for (const OutlineEvidence& frame : frames)
    spread += spread_px(frame, correction, sigma_px) / static_cast<double>(frames.size());
  const WeakestDirection weakest =
      weakest_direction(pool.normal, certainty.covariance, free, pixels, spread);
  certainty.condition = weakest.condition;
  certainty.weakest_px = weakest.sigma_px;
  certainty.weakest = weakest.words;
  const double known = weakest.by.dot(pool.normal * weakest.by);
  for (const ObjectEquations& frame : pool.frames) {
    certainty.without.push_back(correction.changed(changes.without(frame)));
    certainty.information.push_back(known > 0 ? weakest.by.dot(frame.normal * weakest.by) / known
                                              : 0.0);
  }
  return certainty;
}

}  // namespace mapscore
