// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mapscore {

/// Semantic class; 0 is `background`, everything that no class claims.
using ClassId = std::uint16_t;
/// One object of the scene (a matched body); 0 is background.
using InstanceId = std::uint16_t;

inline constexpr ClassId kBackground = 0;

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Colour&) const = default;
};

struct SemanticClass {
  ClassId id = kBackground;
  std::string name = "background";
  Colour colour{128, 128, 128};
  bool detect = false;  ///< becomes a detection; decides the scores more than most faults do
};

struct Instance {
  InstanceId id = 0;
  std::string name = "background";  ///< the body's name in the scene
  ClassId class_id = kBackground;
};

/// Classes and instances of one scene. `classes[i].id == i` and `instances[i].id == i`; entry 0 of
/// both is background. Not changed after loading, so safe to share between threads.
struct ClassTable {
  std::vector<SemanticClass> classes{SemanticClass{}};
  std::vector<Instance> instances{Instance{}};

  /// Class of an instance id as it stands in a label image; ids beyond the table are background.
  [[nodiscard]] ClassId class_of(InstanceId instance) const {
    return instance < instances.size() ? instances[instance].class_id : kBackground;
  }
  [[nodiscard]] bool detected(ClassId id) const {
    return id < classes.size() && classes[id].detect;
  }
};

}  // namespace mapscore
