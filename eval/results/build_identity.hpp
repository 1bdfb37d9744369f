// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

namespace mapscore::eval {

/// Identity of what computes the results of this program: 16 hexadecimal digits, a hash of the
/// sources that decide them without comments and white space, the compiler with its flags, and the
/// versions of MuJoCo, OpenCV, Eigen and OctoMap. Written at each build by
/// cmake/BuildIdentity.cmake.
[[nodiscard]] std::string_view build_identity();

}  // namespace mapscore::eval
