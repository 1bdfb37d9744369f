// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>

namespace mapscore::eval {

/// The robot that comes with the program, found from where its file lies.
[[nodiscard]] std::optional<std::filesystem::path> own_robot();

/// The robot that comes with the program in `folder`, for scenes that have none beside them:
/// scenes/robot.xml of the source tree in which the program was built, or of share/mapscore where
/// it is installed. None when it was moved away alone.
[[nodiscard]] std::optional<std::filesystem::path> own_robot_of(
    const std::filesystem::path& folder);

/// True for a file that names the body `base_footprint`; others' scenes come with robot.xml files
/// that are no robots of ours.
[[nodiscard]] bool names_base_footprint(const std::filesystem::path& robot);

}  // namespace mapscore::eval
