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

/// The upper three rows of the 4 x 4 matrix, one after the other: unlike a quaternion they keep
/// every bit of a pose.
using PoseRows = std::array<double, 12>;

[[nodiscard]] PoseRows rows_of(const Pose& pose);
/// Nothing when a number is not finite or the rotation is off an orthonormal right-handed one by
/// more than 1e-3.
[[nodiscard]] std::optional<Pose> pose_of_rows(const PoseRows& rows);

/// tx ty tz qx qy qz qw (TUM order), metres, unit quaternion with qw >= 0.
using PoseNumbers = std::array<double, 7>;

[[nodiscard]] PoseNumbers numbers_of(const Pose& pose);
/// Nothing when a number is not finite or the quaternion's length is off 1 by more than 1e-3; a
/// smaller error is taken for rounding and removed. The identity comes back as exactly the
/// identity.
[[nodiscard]] std::optional<Pose> pose_of(const PoseNumbers& numbers);
/// The pose of a list [tx, ty, tz, qx, qy, qz, qw], or of the twelve numbers of rows_of. Throws
/// Error naming its place when it is none.
[[nodiscard]] Pose pose_of(const YamlValue& list);

}  // namespace mapscore::eval
