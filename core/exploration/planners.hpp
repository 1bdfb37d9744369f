// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/exploration/exploration.hpp"
#include "core/exploration/explorer.hpp"

#include <cstdint>
#include <memory>

namespace mapscore {

// The explorers of each kind, as make_explorer makes them; parameters and robot must have been
// checked.

[[nodiscard]] std::unique_ptr<Explorer> make(const NextBestView& params,
                                             const ExploringRobot& robot, std::uint64_t seed);
[[nodiscard]] std::unique_ptr<Explorer> make(const NearestFrontier& params,
                                             const ExploringRobot& robot, std::uint64_t seed);
[[nodiscard]] std::unique_ptr<Explorer> make(const RandomView& params, const ExploringRobot& robot,
                                             std::uint64_t seed);
[[nodiscard]] std::unique_ptr<Explorer> make(const LawnMower& params, const ExploringRobot& robot,
                                             std::uint64_t seed);
[[nodiscard]] std::unique_ptr<Explorer> make(const DrawnWaypoints& params,
                                             const ExploringRobot& robot, std::uint64_t seed);

}  // namespace mapscore
