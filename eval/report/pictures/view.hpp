// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/pose.hpp"
#include "eval/recording/recording.hpp"
#include "eval/report/pictures/judgement.hpp"
#include "sim/render/renderer.hpp"

#include <optional>
#include <vector>

namespace mapscore::eval {

/// Looks down on everything that was seen, from the side along which it is longest.
[[nodiscard]] sim::View overview(const std::vector<JudgedMap>& maps);

/// As overview, of everything in a box (world frame, metres).
[[nodiscard]] sim::View overview(const Eigen::AlignedBox3d& bounds);

/// Looks straight down on everything that was seen, from so far above that walls hardly lean:
/// what stands a metre above something else is drawn about 5 cm from it at most. As high as it must
/// be for its width.
[[nodiscard]] sim::View plan_view(const std::vector<JudgedMap>& maps, int width_px);

/// Pixels of a metre at the height of the target, where a view looks straight down; else nothing.
[[nodiscard]] std::optional<double> pixels_per_metre(const sim::View& view);

/// Looks at the place with most false and missed voxels of all maps: from above where one of the
/// cameras was once, or, without any, from the side that the overview looks from.
[[nodiscard]] sim::View error_view(const std::vector<JudgedMap>& maps,
                                   const std::vector<Pose>& T_world_depth);

/// The chosen view, or the overview and the error view.
[[nodiscard]] std::vector<sim::View> error_views(const std::vector<JudgedMap>& maps,
                                                 const std::optional<sim::View>& chosen,
                                                 const std::vector<Pose>& T_world_depth);

/// Poses of the depth camera's optical frame, by frame.
[[nodiscard]] std::vector<Pose> depth_camera_poses(const Recording& recording);

}  // namespace mapscore::eval
