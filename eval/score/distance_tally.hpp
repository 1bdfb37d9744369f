// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace mapscore::eval {

/// Slack on a distance limit, metres. Scenes on round numbers put surfaces exactly at a limit, and
/// rounding must not decide on which side they fall.
inline constexpr double kDistanceSlack_m = 1e-7;

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Distances of one side of the score (predicted cubes to surface, or samples to predicted cubes),
/// kept as integers, so that pooling is exact and depends on no order. Bin b of the histogram holds
/// the distances in ((b - 1) mm, b mm], bin 0 those of zero.
class DistanceTally {
 public:
  DistanceTally() = default;
  /// `limits_m`: the distances tau, ascending, metres.
  explicit DistanceTally(std::vector<double> limits_m);

  /// Everything a tally holds, for writing it to a store and reading it back.
  struct Parts {
    std::vector<double> limits_m;
    std::vector<std::int64_t> within;
    std::int64_t count = 0;
    std::int64_t unreached = 0;  ///< of `count` those with nothing to reach: at infinite distance
    std::int64_t sum_nm = 0;     ///< of the finite distances, each rounded to a nanometre
    std::vector<std::int64_t> bins;
    bool operator==(const Parts&) const = default;
  };
  /// Throws Error when the parts do not belong together.
  explicit DistanceTally(Parts parts);
  [[nodiscard]] const Parts& parts() const { return parts_; }

  /// Counts `times` distances of `distance_m`; kUnreached when there is nothing to reach.
  void add(double distance_m, std::int64_t times = 1);
  /// Pools; a default-made tally takes the limits of the other. Throws Error when limits differ.
  DistanceTally& operator+=(const DistanceTally& other);

  [[nodiscard]] const std::vector<double>& limits_m() const { return parts_.limits_m; }
  /// How many distances are at most limits_m()[limit].
  [[nodiscard]] std::int64_t within(std::size_t limit) const { return parts_.within[limit]; }
  [[nodiscard]] std::int64_t count() const { return parts_.count; }

  /// Mean in metres; nullopt when nothing was counted or the mean is not finite.
  [[nodiscard]] std::optional<double> mean_m() const;
  /// Smallest whole millimetre that at least `share` (0 to 1) of the distances do not exceed, in
  /// metres; nullopt when nothing was counted or it is not finite.
  [[nodiscard]] std::optional<double> percentile_m(double share) const;

  bool operator==(const DistanceTally&) const = default;

 private:
  Parts parts_;
};

}  // namespace mapscore::eval
