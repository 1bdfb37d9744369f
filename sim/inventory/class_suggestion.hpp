// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "sim/inventory/scene_inventory.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace mapscore::sim {

/// A class that a scene seems to have.
struct SuggestedClass {
  std::string name;
  Colour colour;
  bool detect = true;
  std::vector<std::string> patterns;  ///< globs that match `bodies` and no other body of the scene
  std::vector<std::string> bodies;    ///< one an instance
  std::vector<std::string> parts;     ///< named bodies below them with drawn geoms
};

/// What a body's name says of its kind, in lower case: without namespaces (`a/`, `a:`), numbers and
/// such endings as `_main`, `_body` or `_g0`; `kitchen/Chair_03_main` is a `chair`.
[[nodiscard]] std::string stem_of_body(std::string_view body);

/// Groups the objects of a scene by their stems. An object is a named body with drawn geoms, its
/// own or below it; bodies that only hold several others together are looked into. Walls, floors
/// and the like are not detected; nor are geoms that hang on no body (class `world`), unless there
/// is nothing else. Classes in order of their first body, `world` last.
[[nodiscard]] std::vector<SuggestedClass> suggest_classes(const std::vector<BodyEntry>& bodies);

/// `count` colours far from each other and from grey, white and black, the most different first:
/// each is the farthest from those before it in CIE L*a*b*.
[[nodiscard]] std::vector<Colour> separated_colours(std::size_t count);

/// The text of a class file, with its bodies in comments.
[[nodiscard]] std::string class_file_text(const std::vector<SuggestedClass>& classes,
                                          const std::string& scene);

}  // namespace mapscore::sim
