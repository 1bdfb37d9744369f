// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "sim/world/class_file.hpp"

#include <mujoco/mujoco.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::sim {

/// For each body the nearest body, itself or an ancestor, that a class claims; -1 where there is
/// none. A geom belongs to the instance of its body's owner.
struct Ownership {
  std::vector<ClassRule> rules;
  std::vector<int> rule_of_body;   ///< index into `rules` or -1
  std::vector<int> owner_of_body;  ///< body id or -1

  [[nodiscard]] bool opaque(int body) const {
    const int owner = owner_of_body[body];
    return owner >= 0 && rules[rule_of_body[owner]].opaque;
  }
};

/// Matches the bodies of `model` against the class file. Bodies of `robot_body` are never matched.
/// Without a class file each named body is its own instance, of the class that its name gives.
/// Throws Error when a body belongs to two classes, or a pattern that the file gives matches none.
[[nodiscard]] Ownership assign_bodies(const mjModel& model,
                                      const std::optional<std::filesystem::path>& class_file,
                                      const std::vector<bool>& robot_body);

/// Classes, instances and what they own, of the geoms that are drawn.
struct Assignment {
  ClassTable table;
  std::vector<InstanceId> geom_instances;  ///< per geom of the model
  std::vector<std::string> unmatched_bodies;
};

/// Instances are the owners of drawn geoms, in the order of their bodies. Without a class file only
/// their classes are kept, in the same order.
[[nodiscard]] Assignment assign_geoms(const mjModel& model, const Ownership& ownership,
                                      const std::vector<int>& drawn_geoms, bool from_file);

}  // namespace mapscore::sim
