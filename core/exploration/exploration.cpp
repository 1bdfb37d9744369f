// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/exploration/exploration.hpp"

#include "core/exploration/planners.hpp"
#include "core/exploration/surroundings.hpp"

namespace mapscore {

std::unique_ptr<Explorer> make_explorer(const Exploration& exploration, const ExploringRobot& robot,
                                        std::uint64_t seed) {
  check(robot);
  return std::visit(
      [&](const auto& kind) {
        check_ranges(kind);
        return make(kind, robot, seed);
      },
      exploration);
}

}  // namespace mapscore
