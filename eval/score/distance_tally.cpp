// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/score/distance_tally.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mapscore::eval {

namespace {

constexpr double kBin_m = 1e-3;
constexpr double kNanometre_m = 1e-9;

std::size_t bin_of(double distance_m) {
  return static_cast<std::size_t>(
      std::max(0.0, std::ceil((distance_m - kDistanceSlack_m) / kBin_m)));
}

}  // namespace

DistanceTally::DistanceTally(std::vector<double> limits_m) {
  parts_.within.resize(limits_m.size());
  parts_.limits_m = std::move(limits_m);
}

DistanceTally::DistanceTally(Parts parts) : parts_(std::move(parts)) {
  const std::int64_t finite =
      std::accumulate(parts_.bins.begin(), parts_.bins.end(), std::int64_t{0});
  if (parts_.within.size() != parts_.limits_m.size() || finite + parts_.unreached != parts_.count) {
    throw Error("score: the stored distance counts do not add up; compute the trial again");
  }
}

void DistanceTally::add(double distance_m, std::int64_t times) {
  if (times == 0) return;
  parts_.count += times;
  if (distance_m == kUnreached) {
    parts_.unreached += times;
    return;
  }
  for (std::size_t l = 0; l < parts_.limits_m.size(); ++l) {
    if (distance_m <= parts_.limits_m[l] + kDistanceSlack_m) parts_.within[l] += times;
  }
  parts_.sum_nm += times * std::llround(distance_m / kNanometre_m);
  const std::size_t bin = bin_of(distance_m);
  if (bin >= parts_.bins.size()) parts_.bins.resize(bin + 1, 0);
  parts_.bins[bin] += times;
}

DistanceTally& DistanceTally::operator+=(const DistanceTally& other) {
  if (other.parts_.count == 0 && other.parts_.limits_m.empty()) return *this;
  if (parts_.count == 0 && parts_.limits_m.empty()) return *this = other;
  if (parts_.limits_m != other.parts_.limits_m) {
    throw Error(
        "score: counts with different distances_m cannot be pooled; score both with the same list");
  }
  for (std::size_t l = 0; l < parts_.within.size(); ++l) parts_.within[l] += other.parts_.within[l];
  parts_.count += other.parts_.count;
  parts_.unreached += other.parts_.unreached;
  parts_.sum_nm += other.parts_.sum_nm;
  if (parts_.bins.size() < other.parts_.bins.size())
    parts_.bins.resize(other.parts_.bins.size(), 0);
  for (std::size_t b = 0; b < other.parts_.bins.size(); ++b) parts_.bins[b] += other.parts_.bins[b];
  return *this;
}

std::optional<double> DistanceTally::mean_m() const {
  if (parts_.count == 0 || parts_.unreached > 0) return std::nullopt;
  return static_cast<double>(parts_.sum_nm) / static_cast<double>(parts_.count) * kNanometre_m;
}

std::optional<double> DistanceTally::percentile_m(double share) const {
  if (parts_.count == 0) return std::nullopt;
  const auto rank = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(share * static_cast<double>(parts_.count))));
  std::int64_t below = 0;
  for (std::size_t b = 0; b < parts_.bins.size(); ++b) {
    below += parts_.bins[b];
    if (below >= rank) return static_cast<double>(b) * kBin_m;
  }
  return std::nullopt;
}

}  // namespace mapscore::eval
