// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/study.hpp"
#include "eval/localization/filter_run.hpp"
#include "sim/faults/lidar_noise.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace mapscore::eval {

/// Edge of a cell of a grid that is cut from the truth.
[[nodiscard]] double grid_resolution_m(const LocalizationSettings& settings);

/// The preset with the keys that are given in its place, and every dose times `scale`.
[[nodiscard]] sim::LidarNoise noise_of(const LidarFaultSettings& settings);

/// The core's defaults with the keys that are given in their place.
[[nodiscard]] OdometryNoise noise_of(const OdometryNoiseSettings& settings);

/// The filter of a study: as noise_of.
[[nodiscard]] FilterSettings filter_of(const LocalizationSettings& settings,
                                       const LidarFaultSettings& lidar);

/// Least and most particles.
[[nodiscard]] std::pair<std::size_t, std::size_t> particle_bounds(
    const ParticleFilterSettings& settings);

/// Tells the poses of a study by other keys: every default written out that the source uses, and
/// nothing that it does not. The file that it reads is named by `content`, a hash of what it holds.
/// Equal poses give equal settings.
void resolve_localization(LocalizationSettings& localization, FaultSettings& faults,
                          const std::string& content);

}  // namespace mapscore::eval
