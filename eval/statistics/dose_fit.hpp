// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

/// A score at a dose, of one trial.
struct DosePoint {
  double dose = 0.0, score = 0.0;
  std::size_t trial = 0;  ///< position in the list of trials
  bool operator==(const DosePoint&) const = default;
};

/// Least squares polynomial of a score over the dose.
class DoseCurve {
 public:
  /// Throws Error unless there are at least degree + 2 points at degree + 1 doses.
  DoseCurve(std::span<const DosePoint> points, int degree);

  [[nodiscard]] double at(double dose) const { return powers(dose).dot(coefficients_); }
  [[nodiscard]] double slope(double dose) const;
  /// Half of the 95 % interval of the mean score at a dose (Student t).
  [[nodiscard]] double half_width(double dose) const;
  /// What a score at the dose `of` that is higher by 1 raises the curve at `dose` by.
  [[nodiscard]] double influence(double of, double dose) const;
  [[nodiscard]] double residual_sd() const { return residual_sd_; }
  [[nodiscard]] double rss() const { return residual_sd_ * residual_sd_ * degrees_; }
  /// Two-sided p of Student t that the coefficient of the highest power is 0.
  [[nodiscard]] double p_of_highest() const;

 private:
  [[nodiscard]] Eigen::VectorXd powers(double dose) const;

  double centre_ = 0.0, scale_ = 1.0;  ///< powers are those of (dose - centre) / scale
  int degrees_ = 0;                    ///< of freedom
  double residual_sd_ = 0.0;
  double t_ = 0.0;  ///< 0.975 quantile of Student t
  Eigen::VectorXd coefficients_;
  Eigen::MatrixXd unit_covariance_;  ///< of the coefficients, over the residuals' variance
};

/// Where a score falls below a target, as far as points tell.
struct Crossing {
  std::optional<double> dose;       ///< none: not between the least and the greatest dose
  std::optional<double> low, high;  ///< 95 % interval; none: open on this side
};

/// Of a curve between the doses `first` and `last`: the doses where the 95 % interval of its mean
/// holds the target (of a line that is the confidence set of Fieller, 1954), as far as they hang
/// together with the first dose where the curve falls through the target. A side is open where they
/// reach the end. Nothing where the curve does not fall through the target.
[[nodiscard]] Crossing curve_crossing(const DoseCurve& curve, double target, double first,
                                      double last);

/// One fall from a level above the target to one below, between two neighbouring doses.
struct DoseStep {
  Crossing crossing;
  double above = 0.0, below = 0.0;  ///< levels
  double rss = 0.0;
};

/// The step that fits points (ordered by dose, at least four) best by least squares; its interval
/// holds every gap whose RSS is at most RSS_best (1 + F / (n - 3)), F the 0.95 quantile of
/// F(1, n - 3). Nothing where the best step does not cross the target downwards.
[[nodiscard]] std::optional<DoseStep> step_through(std::span<const DosePoint> points,
                                                   double target);

}  // namespace mapscore::eval
