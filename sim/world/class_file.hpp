// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::sim {

/// True when a body's name fits a glob by the rules of the shell (`chair*`, `cup_?`). MuJoCo's
/// `world` body, which holds everything that is in no body, is only matched by its own name.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& body);

/// One line of a class file: a class and the bodies that belong to it.
struct ClassRule {
  SemanticClass semantic_class;
  std::vector<std::string> bodies;  ///< glob patterns over body names
  int line = 0;                     ///< of the patterns in their file; 0 where it gives none
  bool opaque = false;              ///< geoms with alpha below 1 are drawn and counted as solid

  /// True when one of the patterns matches.
  [[nodiscard]] bool matches(const std::string& body) const;
};

/// Reads a class file:
///
///     classes:
///       - {name: cup, colour: "FF0000", detect: true, bodies: ["cup_*"], opaque: false}
///
/// Ids follow the order, from 1. `name` is required; `colour` defaults to `palette_colour(id)`,
/// `detect` to true, `bodies` to `NAME` and `NAME_*`, `opaque` to false. Throws Error with file,
/// line and key for unknown keys, wrong types, and names or patterns that stand twice.
[[nodiscard]] std::vector<ClassRule> read_class_file(const std::filesystem::path& file);

/// The class file beside a scene, STEM.classes.yaml; none where there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> class_file_beside(
    const std::filesystem::path& scene);

/// Class of a body where there is no class file: its name up to the last `_number`.
[[nodiscard]] std::string class_name_of_body(std::string_view body);

/// Distinct colours for classes that name none: hues a golden ratio apart.
[[nodiscard]] Colour palette_colour(ClassId id);

}  // namespace mapscore::sim
