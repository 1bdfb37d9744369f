// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace mapscore::eval {

/// Sums of numbers are kept in billionths, as whole numbers, so that their order does not matter.
inline constexpr std::int64_t kBillion = 1'000'000'000;

/// A named figure; nullopt is undefined (0/0, or not finite) and printed `-`.
struct Metric {
  std::string name;
  std::optional<double> value;

  bool operator==(const Metric&) const = default;
};

/// part / whole; nullopt when whole is 0.
[[nodiscard]] std::optional<double> ratio(std::int64_t part, std::int64_t whole);

/// Harmonic mean of precision true_predicted / predicted and recall found / visible. nullopt when
/// nothing is predicted and nothing is visible; 0 when one of the two is empty or nothing was hit.
[[nodiscard]] std::optional<double> f1(std::int64_t true_predicted, std::int64_t predicted,
                                       std::int64_t found, std::int64_t visible);

/// Pixels of one class: in the truth, named so, and both.
struct ClassOverlap {
  std::int64_t both = 0, truth = 0, named = 0;
};

/// Frequency-weighted IoU: sum over the classes of truth / all * both / (truth + named - both)
/// [Long et al., Fully convolutional networks for semantic segmentation, CVPR 2015]; nullopt
/// without a true pixel.
[[nodiscard]] std::optional<double> frequency_weighted_iou(
    const std::vector<ClassOverlap>& classes);

/// Each figure's mean over the classes where it is defined. All list the same figures in one order;
/// there is at least one.
[[nodiscard]] std::vector<Metric> mean_over_classes(
    const std::vector<std::vector<Metric>>& classes);

/// Whether a figure of that name is the size of an error, from 0 without bound: metres, degrees,
/// percent of a way, normalised squares. All others are shares.
[[nodiscard]] bool is_size_of_error(std::string_view name);

/// The figure of that name, or nullopt when it is undefined. Throws Error when there is none.
[[nodiscard]] std::optional<double> value_of(const std::vector<Metric>& metrics,
                                             const std::string& name);

/// One plain count of an `Owner`: its name in stores and tidy CSV. Every struct of counts lists its
/// own, once, in `counts()`: pooling, store and tables follow.
template <class Owner>
struct CountField {
  std::string_view name;
  std::int64_t Owner::*member;
  bool in_tables = true;  ///< a row of the tidy CSV by itself
};

/// Adds every plain count of `other`.
template <class Owner>
void add_counts(Owner& total, const Owner& other) {
  for (const CountField<Owner>& field : Owner::counts()) total.*field.member += other.*field.member;
}

/// Structs that hold nothing but their plain counts.
template <class Owner>
concept PlainCounts = sizeof(Owner) == std::tuple_size_v<decltype(Owner::counts())> *
                                           sizeof(std::int64_t);

/// Pools.
template <PlainCounts Owner>
Owner& operator+=(Owner& total, const Owner& other) {
  add_counts(total, other);
  return total;
}

/// Pools the steps of a curve, both lists by falling `place`: those of one place become one.
template <class Step>
void pool_steps(std::vector<Step>& total, const std::vector<Step>& other, int Step::*place) {
  std::vector<Step> merged;
  merged.reserve(total.size() + other.size());
  std::ranges::merge(total, other, std::back_inserter(merged), std::greater{}, place, place);
  total.clear();
  for (const Step& step : merged) {
    if (total.empty() || total.back().*place != step.*place)
      total.push_back(step);
    else
      total.back() += step;
  }
}

}  // namespace mapscore::eval
