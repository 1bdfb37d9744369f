// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::sim {

/// A body of a scene at the pose of loading.
struct BodyEntry {
  std::string name;  ///< empty for nameless ones
  int parent = 0;    ///< index among the bodies; the first, `world`, is its own
  bool jointed = false;
  bool matched = false;        ///< a class claims it or an ancestor
  int drawn_geoms = 0;         ///< its own, that are seen and truth
  Eigen::AlignedBox3d bounds;  ///< of these, world frame, metres; planes without end left out
};

/// Parts of a scene that are not drawn and not truth, or that differ from what MuJoCo shows.
struct Unseen {
  int hidden_groups = 0;  ///< geoms in groups 3 to 5
  int invisible = 0;      ///< geoms with alpha 0
  int transparent = 0;    ///< geoms with alpha between 0 and 1 that no class calls opaque
  std::vector<std::string> transparent_bodies;  ///< names of their bodies, each once
  int infinite_planes = 0;
  int flexes = 0, skins = 0, sites = 0;
  int keyframes = 0;
  bool no_light = false;  ///< neither a light nor a headlight
};

/// What is in an MJCF file, to write its class file by.
struct SceneInventory {
  std::vector<BodyEntry> bodies;  ///< in the order of the model
  Unseen unseen;
  Eigen::AlignedBox3d bounds;  ///< of all drawn geoms, as for a body
};

/// Takes the inventory of a scene with the class file beside it, if there is one. Throws Error as
/// World::load.
[[nodiscard]] SceneInventory take_inventory(const std::filesystem::path& scene);

}  // namespace mapscore::sim
