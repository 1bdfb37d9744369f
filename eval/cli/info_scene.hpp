// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// What `mapscore info` is asked to do with a scene.
struct SceneInfoFlags {
  std::string picture;  ///< file; empty: STEM.classes.png beside the scene
  bool no_picture = false;
  bool suggest_classes = false;  ///< print or write a class file instead
  std::string output;            ///< of the suggestion; empty: standard output

  [[nodiscard]] bool any() const {
    return no_picture || suggest_classes || !picture.empty() || !output.empty();
  }
};

/// A line a class: id, name, colour, detected or not, number of instances.
void print_classes(const ClassTable& table);

/// Prints classes, extents, bodies that no class claims and what will not be seen as it stands, and
/// draws the picture; or suggests a class file. Throws Error when the scene is refused, the program
/// was built without the simulator, or a named file cannot be written or, for a class file, exists.
void info_of_scene(const std::filesystem::path& scene, const SceneInfoFlags& flags);

}  // namespace mapscore::eval
