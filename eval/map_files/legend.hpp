// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/map_files/map_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mapscore::eval {

/// What the labels of a map mean in the truth's classes. kBackground: no class.
struct Legend {
  std::map<std::uint32_t, ClassId> colours;  ///< 0xRRGGBB
  std::map<std::uint32_t, ClassId> ids;      ///< negative ones in two's complement
  std::map<std::string, ClassId> names;
};

/// Reads a legend as docs/formats.md has it. Throws Error with file and line: broken YAML, unknown
/// keys and classes, labels that are none, doubled entries, a legend that names no class.
[[nodiscard]] Legend read_legend(const std::filesystem::path& file, const ClassTable& table);

/// A label without meaning, as the legend would spell it.
struct Leftover {
  std::string label;
  std::size_t count = 0;  ///< occupied elements that bear it
  bool operator==(const Leftover&) const = default;
};

/// All labels of a map, whatever they mean, most frequent first, then by label.
[[nodiscard]] std::vector<Leftover> labels_of(const MapFile& map);

/// The class of each element of a map.
struct Labelling {
  std::vector<ClassId> classes;     ///< kBackground: none
  std::vector<Leftover> leftovers;  ///< most frequent first, then by label
  /// Colours and ids of a class that a legend does not list; in the same order.
  std::vector<Leftover> unlisted;
};

/// Gives the labels of a map their meaning: what the legend says, else a class's own colour, id or
/// name. Throws Error with the commonest labels when the map has labels and none means a class,
/// when those of more than 95 % of its occupied elements mean nothing (more than half of them in
/// more than 1000 colours: a camera's), or for a colour of two classes that no legend lists.
[[nodiscard]] Labelling apply_legend(const MapFile& map, const std::optional<Legend>& legend,
                                     const ClassTable& table);

}  // namespace mapscore::eval
