// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/cli/map_flags.hpp"
#include "eval/lab/folder_poses.hpp"
#include "eval/study/study.hpp"

#include <optional>

namespace mapscore::eval {

/// Throws Error for a key of --set that changes nothing: a folder is mapped as it is, and obeys the
/// keys of how poses are found in its depth images where they are.
void check_keys(Study study, const MapVerbFlags& flags);

/// Finds the poses of a folder in its depth images, as the study says if there is one, and places
/// its frames there; warns where they are guessed. Throws Error as find_poses.
[[nodiscard]] FolderPoses found_poses(const MapVerbFlags& flags, const std::optional<Study>& study,
                                      LabelledFolder& folder);

}  // namespace mapscore::eval
