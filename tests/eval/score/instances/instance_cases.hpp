// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/random_stream.hpp"
#include "eval/score/instances/instance_pieces.hpp"
#include "tests/eval/score/score_cases.hpp"

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace mapscore::eval::testing {

/// Two detected classes, cup (1) and chair (2), and a wall (3) that is not; instances 1 and 2 are
/// cups, 3 and 4 chairs, 5 the wall.
inline ClassTable cups_and_chairs() {
  ClassTable table;
  table.classes.push_back({1, "cup", {}, true});
  table.classes.push_back({2, "chair", {}, true});
  table.classes.push_back({3, "wall", {}, false});
  table.instances.push_back({1, "cup_1", 1});
  table.instances.push_back({2, "cup_2", 1});
  table.instances.push_back({3, "chair_1", 2});
  table.instances.push_back({4, "chair_2", 2});
  table.instances.push_back({5, "wall_1", 3});
  return table;
}

/// A random world of those instances, and a map of it that is partly right.
struct InstanceCase {
  std::set<std::pair<VoxelKey, ClassId>> surface;  ///< by instance
  std::map<VoxelKey, ClassId> owners;              ///< by instance
  std::vector<MapVoxel> map;                       ///< by class
  std::vector<NumberedVoxel> numbers;
};

inline InstanceCase instance_case(std::uint64_t seed) {
  RandomStream random(seed, "instance test");
  const ClassTable table = cups_and_chairs();
  const double blur = 0.5 * random.uniform(), unseen = 0.6 * random.uniform();
  InstanceCase made;
  // Runs along k, so that pieces are larger than a voxel; gaps between them.
  for (int i = 0; i < 12; i += 1 + static_cast<int>(random.uniform() * 2)) {
    const auto instance = static_cast<InstanceId>(random.uniform() * 6);
    const auto second = static_cast<InstanceId>(random.uniform() * 6);
    const bool hidden = random.uniform() < unseen;
    for (int k = 0; k < 8; ++k) {
      const VoxelKey key{i - 6, static_cast<int>(random.uniform() * 2), k - 4};
      made.surface.insert({key, instance});
      if (random.uniform() < 0.3) made.surface.insert({key, second});
      if (!hidden && instance != 0 && random.uniform() < 0.8) made.owners[key] = instance;
      if (random.uniform() < 0.15) continue;
      const bool wrong = random.uniform() < blur;
      const auto class_id =
          wrong ? static_cast<ClassId>(random.uniform() * 4) : table.class_of(instance);
      const double probability = static_cast<int>(random.uniform() * 8) / 8.0;
      made.map.push_back({key, class_id, probability, random.uniform() < 0.95});
      const auto number = static_cast<std::uint32_t>(random.uniform() * 7);
      if (random.uniform() < 0.9) made.numbers.push_back({key, number});
    }
  }
  return made;
}

}  // namespace mapscore::eval::testing
