// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mapscore::eval {

/// Elements of two lists that belong together.
struct Association {
  std::size_t first = 0, second = 0;
  bool operator==(const Association&) const = default;
};

/// Pairs of stamps that are less than `max_offset_s` apart, each stamp in one pair at most, the
/// nearest pairs first, as the TUM benchmark associates its images; ties to the earlier stamps.
/// Both lists ascend. Ascending by `first`.
[[nodiscard]] std::vector<Association> associate(std::span<const double> first_s,
                                                 std::span<const double> second_s,
                                                 double max_offset_s);

}  // namespace mapscore::eval
