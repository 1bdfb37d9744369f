// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/score/metric.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace mapscore::eval {

/// Of the voxels of P_c and V_c those that belong to thin parts (distances/thin_score.hpp).
struct ThinCounts {
  std::int64_t predicted = 0, true_predicted = 0;
  std::int64_t visible = 0, found = 0;

  /// thin_precision, thin_recall, thin_f1, in this order.
  [[nodiscard]] std::vector<Metric> metrics() const {
    return {{"thin_precision", ratio(true_predicted, predicted)},
            {"thin_recall", ratio(found, visible)},
            {"thin_f1", f1(true_predicted, predicted, found, visible)}};
  }

  static auto counts() {
    return std::to_array<CountField<ThinCounts>>({
        {"thin_predicted", &ThinCounts::predicted},
        {"thin_true_predicted", &ThinCounts::true_predicted},
        {"thin_visible", &ThinCounts::visible},
        {"thin_found", &ThinCounts::found},
    });
  }
  /// Pools.
  ThinCounts& operator+=(const ThinCounts& other) {
    add_counts(*this, other);
    return *this;
  }
  bool operator==(const ThinCounts&) const = default;
};

}  // namespace mapscore::eval
