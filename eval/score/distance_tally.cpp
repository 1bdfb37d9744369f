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

DistanceTally::DistanceTally(std::vector<double> limits_m)
    : limits_m_(std::move(limits_m)), within_(limits_m_.size(), 0) {}

DistanceTally::DistanceTally(Parts parts)
    : limits_m_(std::move(parts.limits_m)),
      within_(std::move(parts.within)),
      count_(parts.count),
      unreached_(parts.unreached),
      sum_nm_(parts.sum_nm),
      bins_(std::move(parts.bins)) {
  const std::int64_t finite = std::accumulate(bins_.begin(), bins_.end(), std::int64_t{0});
  if (within_.size() != limits_m_.size() || finite + unreached_ != count_) {
    throw Error("score: the stored distance counts do not add up; compute the trial again");
  }
}

DistanceTally::Parts DistanceTally::parts() const {
  return {limits_m_, within_, count_, unreached_, sum_nm_, bins_};
}

void DistanceTally::add(double distance_m, std::int64_t times) {
  if (times == 0) return;
  count_ += times;
  if (distance_m == kUnreached) {
    unreached_ += times;
    return;
  }
  for (std::size_t l = 0; l < limits_m_.size(); ++l) {
    if (distance_m <= limits_m_[l] + kDistanceSlack_m) within_[l] += times;
  }
  sum_nm_ += times * std::llround(distance_m / kNanometre_m);
  const std::size_t bin = bin_of(distance_m);
  if (bin >= bins_.size()) bins_.resize(bin + 1, 0);
  bins_[bin] += times;
}

DistanceTally& DistanceTally::operator+=(const DistanceTally& other) {
  if (other.count_ == 0 && other.limits_m_.empty()) return *this;
  if (count_ == 0 && limits_m_.empty()) return *this = other;
  if (limits_m_ != other.limits_m_) {
    throw Error(
        "score: counts with different distances_m cannot be pooled; score both with the same list");
  }
  for (std::size_t l = 0; l < within_.size(); ++l) within_[l] += other.within_[l];
  count_ += other.count_;
  unreached_ += other.unreached_;
  sum_nm_ += other.sum_nm_;
  if (bins_.size() < other.bins_.size()) bins_.resize(other.bins_.size(), 0);
  for (std::size_t b = 0; b < other.bins_.size(); ++b) bins_[b] += other.bins_[b];
  return *this;
}

std::optional<double> DistanceTally::mean_m() const {
  if (count_ == 0 || unreached_ > 0) return std::nullopt;
  return static_cast<double>(sum_nm_) / static_cast<double>(count_) * kNanometre_m;
}

std::optional<double> DistanceTally::percentile_m(double share) const {
  if (count_ == 0) return std::nullopt;
  const auto rank = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(share * static_cast<double>(count_))));
  std::int64_t below = 0;
  for (std::size_t b = 0; b < bins_.size(); ++b) {
    below += bins_[b];
    if (below >= rank) return static_cast<double>(b) * kBin_m;
  }
  return std::nullopt;
}

}  // namespace mapscore::eval
