// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"
#include "eval/report/pictures_trial.hpp"
#include "sim/render/renderer.hpp"

#include <Eigen/Geometry>
#include <vector>

namespace mapscore::eval {

/// Looks down on everything that was seen, from the side along which it is longest.
[[nodiscard]] sim::View overview(const std::vector<TrialMap>& maps);

/// Looks at the place with most false and missed voxels of all maps, from above where the camera
/// was once.
[[nodiscard]] sim::View error_view(const std::vector<TrialMap>& maps, const Recording& recording);

}  // namespace mapscore::eval
