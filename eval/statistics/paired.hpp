// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/statistics/intervals.hpp"

#include <optional>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Up to this many differences other than 0, p is exact; above, from random sign patterns.
inline constexpr int kExactSignFlips = 20;

/// Two methods over the same seeds, seed by seed.
struct PairedComparison {
  /// Of a - b; `seeds` counts the pairs, `undefined` the seeds that lack a or b.
  SeedSummary difference;
  std::optional<double> mean_a, mean_b;  ///< over the pairs
  std::optional<double> p;               ///< two-sided; none without a pair
  bool exact = true;                     ///< p is over all sign patterns
};

/// Compares one value a seed of two methods; position i of both is the same seed. Throws Error when
/// they differ in length.
[[nodiscard]] PairedComparison compare_paired(std::span<const std::optional<double>> a,
                                              std::span<const std::optional<double>> b);

/// Two-sided p of the sign-flip permutation test: the share of the 2^n patterns of signs with
/// |sum of s_i d_i| >= |sum of d_i|, under the hypothesis that each difference is as likely as its
/// negative. Differences of 0 change nothing and are left out. Sums are whole multiples of
/// 2^-40 max |d|, and one that is smaller by at most 2^-30 sum |d| counts as equal. Exact up to
/// kExactSignFlips; above, (hits + 1) / (B + 1) of B = 99999 patterns from a stream of their own,
/// the same at each call. 1 where all differences are 0. Differences must be finite.
[[nodiscard]] double sign_flip_p(std::span<const double> differences);

/// The least p that sign_flip_p can give for this many differences other than 0.
[[nodiscard]] double least_sign_flip_p(int differences);

/// Holm's step-down p values of a family, in its order; undefined ones stay so and do not count:
/// the k-th smallest of m times m - k + 1, at most 1, and no less than the one before.
[[nodiscard]] std::vector<std::optional<double>> holm_adjusted(
    std::span<const std::optional<double>> p);

}  // namespace mapscore::eval
