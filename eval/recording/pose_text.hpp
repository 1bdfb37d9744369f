// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"

#include <array>
#include <optional>

namespace mapscore {
struct YamlValue;
}

namespace mapscore::eval {

/// tx ty tz qx qy qz qw (TUM order), metres, unit quaternion with qw >= 0.
using PoseNumbers = std::array<double, 7>;

[[nodiscard]] PoseNumbers numbers_of(const Pose& pose);
/// Nothing when a number is not finite or the quaternion's length is off 1 by more than 1e-3; a
/// smaller error is taken for rounding and removed. The identity comes back as exactly the
/// identity.
[[nodiscard]] std::optional<Pose> pose_of(const PoseNumbers& numbers);
/// The pose of a list [tx, ty, tz, qx, qy, qz, qw]. Throws Error naming its place when it is none.
[[nodiscard]] Pose pose_of(const YamlValue& list);

}  // namespace mapscore::eval
