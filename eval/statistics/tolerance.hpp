// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/statistics/dose_fit.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mapscore::eval {

// The largest dose of a fault at which a score still keeps a target, searched in stages
// (docs/tolerance.md). Trial n of a search has a seed of its own, so that trials are independent.

/// Doses of the first stage, equally spaced over the range.
inline constexpr int kCoarseDoses = 12;
/// Stages after it, which share the other trials.
inline constexpr int kFineStages = 3;
/// Trials at the one dose that speaks most against a single crossing, where there is one.
inline constexpr int kDoubtTrials = 6;
/// Fewest trials of a search.
inline constexpr int kLeastTrials = kCoarseDoses + 4 * kFineStages;

/// What is searched for. The score is taken for one that falls with the dose.
struct ToleranceSearch {
  double low = 0.0, high = 1.0;  ///< range of doses, low < high
  double target = 0.0;           ///< the score to keep
  int trials = 42;               ///< without kDoubtTrials; kLeastTrials or more
};

/// One trial; the position in a list of them is the index of its seed.
struct DoseTrial {
  double dose = 0.0;
  std::optional<double> score;  ///< none: undefined, left out
};

enum class ToleranceVerdict {
  found,         ///< crosses the target within the range
  above,         ///< keeps the target over the whole range
  below,         ///< misses the target from the least dose on
  open,          ///< crosses somewhere, but the trials do not tell where
  not_monotone,  ///< crosses the target more than once
  undefined,     ///< too few trials have a score
};

[[nodiscard]] constexpr std::string_view name_of(ToleranceVerdict verdict) {
  return std::array<std::string_view, 6>{"found", "above",        "below",
                                         "open",  "not monotone", "undefined"}
      .at(static_cast<std::size_t>(verdict));
}

/// The largest dose that keeps the target. Within the range of the search, never beyond it.
struct Tolerance {
  ToleranceVerdict verdict = ToleranceVerdict::open;
  std::optional<double> dose;       ///< of `found` alone
  std::optional<double> low, high;  ///< 95 % interval; none: this side is open
  std::optional<DoseCurve> curve;   ///< that it was read from
  std::optional<DoseStep> step;     ///< in place of a curve
  std::vector<DosePoint> points;    ///< through which these lead, by dose
  int trials = 0, undefined = 0;    ///< all that were made; those without a score
};

/// Doses of the next stage after these trials; none when the search is over. The same trials give
/// the same doses. Throws Error when the search makes no sense (range, trials).
[[nodiscard]] std::vector<double> next_doses(const ToleranceSearch& search,
                                             std::span<const DoseTrial> trials);

/// What finished trials say. Throws Error as next_doses.
[[nodiscard]] Tolerance tolerance_of(const ToleranceSearch& search,
                                     std::span<const DoseTrial> trials);

/// The tolerance of `a` less that of `b`, of searches whose trial n has the same seed: the two
/// intervals joined by the method of variance estimates recovery (Zou and Donner 2008, correlated),
/// the correlation of the two errors being that of the residuals of equal seeds times that of their
/// influences. Without both doses, what the ends of the intervals alone leave. Nothing where one is
/// not monotone.
[[nodiscard]] Crossing difference_of(const Tolerance& a, const Tolerance& b);

}  // namespace mapscore::eval
