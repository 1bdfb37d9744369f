// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Core>
#include <vector>

namespace mapscore::testing {

using Points = std::vector<Eigen::Vector3d>;

}  // namespace mapscore::testing
