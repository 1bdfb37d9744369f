// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/random_stream.hpp"
#include "eval/statistics/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace mapscore::eval {

/// A mean score over doses from 0 to 60, of about the size of the demo's.
struct KnownCurve {
  const char* name;
  double (*mean)(double dose);
  double target;
  bool crosses_again = false;

  /// The first dose that misses the target; infinite where none does, below 0 where all do.
  [[nodiscard]] double threshold() const {
    if (mean(0.0) < target) return -1.0;
    for (double dose = 0.0; dose <= 60.0; dose += 0.001)
      if (mean(dose) < target) return dose;
    return std::numeric_limits<double>::infinity();
  }
};

inline std::vector<KnownCurve> known_curves() {
  return {
      {"exponential", [](double d) { return .46 + .30 * std::exp(-d / 12); }, .65},
      {"power", [](double d) { return .89 - .17 * std::pow(d / 40, .8); }, .80},
      {"logistic", [](double d) { return .3 + .6 / (1 + std::exp((d - 22) / 5)); }, .6},
      {"logistic, high", [](double d) { return .3 + .6 / (1 + std::exp((d - 22) / 5)); }, .85},
      {"logistic, sharp", [](double d) { return .3 + .6 / (1 + std::exp(d - 22)); }, .8},
      {"step", [](double d) { return d < 23.7 ? .9 : .3; }, .6},
      {"step, high", [](double d) { return d < 23.7 ? .9 : .3; }, .85},
      {"step, small", [](double d) { return d < 23.7 ? .82 : .78; }, .8},
      {"kink", [](double d) { return d < 20 ? .9 : .9 - .01 * (d - 20); }, .88},
      {"shallow", [](double d) { return .82 - .0008 * d; }, .8},
      {"flat, near", [](double) { return .805; }, .8},
      {"flat, above", [](double) { return .84; }, .8},
      {"flat, below", [](double) { return .76; }, .8},
      {"bumpy", [](double d) { return .85 - .004 * d + .03 * std::sin(d / 4); }, .7},
      {"bumpy, thrice", [](double d) { return .85 - .003 * d + .09 * std::sin(d / 6); }, .75, true},
  };
}

enum class Noise { normal, binomial, heavy, growing };
constexpr auto names_of(Noise) {
  return std::to_array<std::string_view>({"normal", "binomial", "heavy", "growing"});
}

/// One trial's score: normal of sd .012; the share of 200 draws; Student t of 3 degrees, scaled by
/// .008; normal, its sd growing from .004 to .022 with the dose.
inline double noisy(double mean, double dose, Noise noise, RandomStream& random) {
  switch (noise) {
    case Noise::normal:
      return mean + .012 * random.normal();
    case Noise::growing:
      return mean + (.004 + .0003 * dose) * random.normal();
    case Noise::binomial: {
      int hits = 0;
      for (int n = 0; n < 200; ++n) hits += random.uniform() < mean ? 1 : 0;
      return hits / 200.0;
    }
    case Noise::heavy: {
      const double normal = random.normal();
      double squares = 0.0;
      for (int n = 0; n < 3; ++n) squares += std::pow(random.normal(), 2);
      return mean + .008 * normal / std::sqrt(squares / 3);
    }
  }
  return mean;
}

/// One search to its end; doses are tried in hundredths, as the verb rounds them. `score` is asked
/// with the dose and the trial.
template <typename Score>
Tolerance searched(const KnownCurve& curve, int trials, const Score& score) {
  const ToleranceSearch search{0.0, 60.0, curve.target, trials};
  std::vector<DoseTrial> made;
  for (;;) {
    const std::vector<double> doses = next_doses(search, made);
    if (doses.empty()) return tolerance_of(search, made);
    for (const double asked : doses) {
      const double dose = std::round(asked * 100.0) / 100.0;
      made.push_back({dose, score(dose, made.size())});
    }
  }
}

inline Tolerance searched(const KnownCurve& curve, Noise noise, std::uint64_t repeat,
                          int trials = 42) {
  RandomStream random(repeat, curve.name, {static_cast<std::uint64_t>(noise)});
  return searched(curve, trials, [&](double dose, std::size_t) {
    return noisy(curve.mean(dose), dose, noise, random);
  });
}

/// What many searches of one curve gave.
struct Coverage {
  double share = 0.0;        ///< whose interval holds the threshold, an open side holding all
  double both_ends = 0.0;    ///< share with both ends
  double half_width = -1.0;  ///< median of those; negative without any
  double not_monotone = 0.0, trials = 0.0;  ///< share; mean
};

inline Coverage coverage_of(const KnownCurve& curve, Noise noise, int repeats, int trials = 42) {
  constexpr double kRounding = 0.005;  // of the doses
  const double threshold = curve.threshold();
  Coverage coverage;
  std::vector<double> half_widths;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Tolerance of = searched(curve, noise, static_cast<std::uint64_t>(repeat), trials);
    const bool warned = of.verdict == ToleranceVerdict::not_monotone;
    const bool held = (!of.low || *of.low <= threshold + kRounding) &&
                      (!of.high || *of.high >= threshold - kRounding);
    coverage.share += held || (warned && curve.crosses_again) ? 1.0 / repeats : 0.0;
    coverage.not_monotone += warned ? 1.0 / repeats : 0.0;
    coverage.trials += of.trials / static_cast<double>(repeats);
    if (of.low && of.high) half_widths.push_back(0.5 * (*of.high - *of.low));
  }
  coverage.both_ends = static_cast<double>(half_widths.size()) / repeats;
  std::ranges::sort(half_widths);
  if (!half_widths.empty()) coverage.half_width = half_widths[half_widths.size() / 2];
  return coverage;
}

/// What the difference of two tolerances gave over many pairs of searches.
struct PairCoverage {
  double share = 0.0;        ///< whose interval holds the difference of the thresholds
  double half_width = 0.0;   ///< median of those with two ends
  double if_unpaired = 0.0;  ///< median where the second search has seeds of its own
};

/// Normal noise of .012, of which the share `common` is the seed's own for both curves.
inline PairCoverage coverage_of_pairs(const KnownCurve& a, const KnownCurve& b, double common,
                                      int repeats) {
  PairCoverage coverage;
  std::vector<double> paired, unpaired;
  const double difference = a.threshold() - b.threshold();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto search = [&](const KnownCurve& curve, std::uint64_t which, std::uint64_t seeds) {
      return searched(curve, 42, [&](double dose, std::size_t trial) {
        RandomStream of_seed(static_cast<std::uint64_t>(repeat), "pair", {seeds, trial});
        RandomStream own(static_cast<std::uint64_t>(repeat), "own", {which, trial});
        return curve.mean(dose) + .012 * (std::sqrt(common) * of_seed.normal() +
                                          std::sqrt(1.0 - common) * own.normal());
      });
    };
    const Tolerance of_a = search(a, 0, 0);
    const Crossing of = difference_of(of_a, search(b, 1, 0));
    const Crossing other = difference_of(of_a, search(b, 1, 1));
    coverage.share += (!of.low || *of.low <= difference) && (!of.high || *of.high >= difference)
                          ? 1.0 / repeats
                          : 0.0;
    if (of.low && of.high) paired.push_back(0.5 * (*of.high - *of.low));
    if (other.low && other.high) unpaired.push_back(0.5 * (*other.high - *other.low));
  }
  const auto median = [](std::vector<double>& values) {
    std::ranges::sort(values);
    return values.empty() ? -1.0 : values[values.size() / 2];
  };
  coverage.half_width = median(paired);
  coverage.if_unpaired = median(unpaired);
  return coverage;
}

}  // namespace mapscore::eval
