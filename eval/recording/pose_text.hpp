// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// tx ty tz qx qy qz qw (TUM order), metres, unit quaternion with qw >= 0.
using PoseNumbers = std::array<double, 7>;

[[nodiscard]] PoseNumbers numbers_of(const Pose& pose);
/// Nothing when a number is not finite or the quaternion's length is off 1 by more than 1e-3; a
/// smaller error is taken for rounding and removed. The identity comes back as exactly the
/// identity.
[[nodiscard]] std::optional<Pose> pose_of(const PoseNumbers& numbers);

/// Shortest texts that read back as the same doubles, with `separator` between them.
[[nodiscard]] std::string join_numbers(std::span<const double> numbers, std::string_view separator);

/// The finite number that is the whole of `text`.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

}  // namespace mapscore::eval
