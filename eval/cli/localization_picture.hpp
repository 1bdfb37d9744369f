// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/occupancy_grid.hpp"
#include "eval/localization/believed_trajectory.hpp"
#include "eval/recording/stamp_list.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Draws trajectory.png and .pdf into a folder: the true frames, the belief of `source` at them
/// with 2-sigma ellipses every few metres, and the odometry alone. Throws Error as
/// draw_trajectories.
void draw_localization(const OccupancyGrid& grid, const BelievedTrajectory& believed,
                       const std::vector<TrajectoryPose>& frames, const std::string& source,
                       const std::filesystem::path& folder);

}  // namespace mapscore::eval
