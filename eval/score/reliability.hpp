// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace mapscore::eval {

/// Verdicts of one bin of confidence.
struct ConfidenceBin {
  std::int64_t count = 0, right = 0;
  std::int64_t confidence_sum_nano = 0;  ///< each rounded to 1e-9

  bool operator==(const ConfidenceBin&) const = default;
};

/// How sure verdicts were, and how often they were right: integers that add over frames, trials and
/// classes.
struct Reliability {
  /// Ten, [0, 0.1), [0.1, 0.2), ... [0.9, 1], as of the voxels of a map (class_curve.hpp).
  static constexpr std::size_t kBins = 10;
  std::array<ConfidenceBin, kBins> bins{};

  /// Adds `times` verdicts of one confidence, 0 to 1.
  void add(double confidence, bool is_right, std::int64_t times = 1) {
    const auto nano = static_cast<std::int64_t>(std::llround(confidence * kBillion));
    const auto place = static_cast<std::size_t>(nano / (kBillion / kBins));
    ConfidenceBin& bin = bins[std::min(place, kBins - 1)];
    bin.count += times;
    bin.right += is_right ? times : 0;
    bin.confidence_sum_nano += times * nano;
  }

  /// Expected calibration error, sum over the bins of |right - sum of confidences| / count of all
  /// [Guo et al., On Calibration of Modern Neural Networks, ICML 2017, equation 3]; nullopt without
  /// a verdict.
  [[nodiscard]] std::optional<double> error() const {
    std::int64_t count = 0, gaps_nano = 0;
    for (const ConfidenceBin& bin : bins) {
      count += bin.count;
      gaps_nano += std::abs(bin.right * kBillion - bin.confidence_sum_nano);
    }
    if (count == 0) return std::nullopt;
    return static_cast<double>(gaps_nano) / static_cast<double>(kBillion) /
           static_cast<double>(count);
  }

  /// Pools.
  Reliability& operator+=(const Reliability& other) {
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
      bins[bin].count += other.bins[bin].count;
      bins[bin].right += other.bins[bin].right;
      bins[bin].confidence_sum_nano += other.bins[bin].confidence_sum_nano;
    }
    return *this;
  }
  bool operator==(const Reliability&) const = default;
};

}  // namespace mapscore::eval
