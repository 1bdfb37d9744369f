// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/paired.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace mapscore::eval {
namespace {

constexpr std::int64_t kRandomPatterns = 99999;
constexpr double kSteps = 0x1.0p40;            ///< of the largest difference
constexpr std::int64_t kEqualShare = 1 << 30;  ///< sums this share of sum |d| apart are equal

/// Differences other than 0 in whole steps, so that every order of summing gives the same sum.
std::vector<std::int64_t> in_steps(std::span<const double> differences) {
  double largest = 0.0;
  for (const double difference : differences) largest = std::max(largest, std::abs(difference));
  std::vector<std::int64_t> steps;
  for (const double difference : differences) {
    if (difference != 0.0) steps.push_back(std::llround(difference / largest * kSteps));
  }
  return steps;
}

/// |sum| from which on a pattern counts as extreme as the one that was seen.
std::int64_t threshold_of(const std::vector<std::int64_t>& steps) {
  std::int64_t sum = 0, absolute = 0;
  for (const std::int64_t step : steps) {
    sum += step;
    absolute += std::abs(step);
  }
  return std::abs(sum) - absolute / kEqualShare;
}

/// All patterns in the order of a Gray code, one sign flipped at a time. The last sign stays: a
/// pattern and its opposite are equally extreme.
double exact_p(const std::vector<std::int64_t>& steps, std::int64_t threshold) {
  std::vector<std::int64_t> signed_steps = steps;
  std::int64_t sum = std::accumulate(steps.begin(), steps.end(), std::int64_t{0});
  const std::uint64_t patterns = std::uint64_t{1} << (steps.size() - 1);
  std::uint64_t hits = std::abs(sum) >= threshold ? 1 : 0;
  for (std::uint64_t pattern = 1; pattern < patterns; ++pattern) {
    std::int64_t& flipped = signed_steps[static_cast<std::size_t>(std::countr_zero(pattern))];
    sum -= 2 * flipped;
    flipped = -flipped;
    hits += std::abs(sum) >= threshold ? 1 : 0;
  }
  return static_cast<double>(hits) / static_cast<double>(patterns);
}

double random_p(const std::vector<std::int64_t>& steps, std::int64_t threshold) {
  RandomStream random(0, "sign flips", {steps.size()});
  std::int64_t hits = 0;
  for (std::int64_t pattern = 0; pattern < kRandomPatterns; ++pattern) {
    std::int64_t sum = 0;
    std::uint64_t signs = 0;
    for (std::size_t i = 0; i < steps.size(); ++i, signs >>= 1) {
      if (i % 64 == 0) signs = random.bits();
      sum += (signs & 1) != 0 ? steps[i] : -steps[i];
    }
    hits += std::abs(sum) >= threshold ? 1 : 0;
  }
  return static_cast<double>(hits + 1) / static_cast<double>(kRandomPatterns + 1);
}

bool is_exact(std::size_t differences) {
  return differences <= static_cast<std::size_t>(kExactSignFlips);
}

}  // namespace

double sign_flip_p(std::span<const double> differences) {
  const std::vector<std::int64_t> steps = in_steps(differences);
  if (steps.empty()) return 1.0;
  const std::int64_t threshold = threshold_of(steps);
  return is_exact(steps.size()) ? exact_p(steps, threshold) : random_p(steps, threshold);
}

double least_sign_flip_p(int differences) {
  if (differences < 1) return 1.0;
  return is_exact(static_cast<std::size_t>(differences))
             ? std::ldexp(1.0, 1 - differences)
             : 1.0 / static_cast<double>(kRandomPatterns + 1);
}

PairedComparison compare_paired(std::span<const std::optional<double>> a,
                                std::span<const std::optional<double>> b) {
  if (a.size() != b.size())
    throw Error(fmt::format("compare_paired: {} values against {}; give one a seed of both",
                            a.size(), b.size()));
  std::vector<std::optional<double>> differences, paired_a, paired_b;
  std::vector<double> defined;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(a[i] && b[i] ? std::optional(*a[i] - *b[i]) : std::nullopt);
    if (!differences.back()) continue;
    defined.push_back(*differences.back());
    paired_a.push_back(a[i]);
    paired_b.push_back(b[i]);
  }
  PairedComparison comparison;
  comparison.difference = summarise(differences);
  comparison.mean_a = summarise(paired_a).mean;
  comparison.mean_b = summarise(paired_b).mean;
  if (defined.empty()) return comparison;
  comparison.p = sign_flip_p(defined);
  comparison.exact = is_exact(in_steps(defined).size());
  return comparison;
}

std::vector<std::optional<double>> holm_adjusted(std::span<const std::optional<double>> p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p[i]) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t left, std::size_t right) { return *p[left] < *p[right]; });
  std::vector<std::optional<double>> adjusted(p.size());
  double floor = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    floor = std::max(floor, std::min(1.0, static_cast<double>(order.size() - k) * *p[order[k]]));
    adjusted[order[k]] = floor;
  }
  return adjusted;
}

}  // namespace mapscore::eval
