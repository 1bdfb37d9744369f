// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace mapscore::eval {

// A struct of settings lists its fields once, in a function found by its argument:
//
//   void fields(auto&& visit, Of<CameraSettings> auto& s) {
//     visit(Field{"width_px", "width of both images", {16, 8192}}, s.width_px);
//     ...
//   }
//
// Loader, setter, dumper and reference are visitors of these lists.

/// Interval of a number; open ends are left out of it. Default: any number that is finite.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;

  [[nodiscard]] bool holds(double value) const {
    return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
  }
  /// For people: "from 0, up to 1", "above 0", "from 0 up", "any".
  [[nodiscard]] std::string text() const;
};

[[nodiscard]] inline Range at_least(double low) {
  return {.low = low};
}
[[nodiscard]] inline Range above(double low, double high = Range{}.high) {
  return {.low = low, .high = high, .open_low = true};
}

/// What there is to know of one key besides its type and its default. `range` bounds each number of
/// it. Where the leaf's text is `unkeyed`, a trial's key is made without it (see to_key_yaml); a
/// section's text is `{}` when all of its leaves are left out, a choice's text is its kind.
struct Field {
  std::string_view key;
  std::string_view meaning;
  Range range = {};
  bool required = false;
  std::string_view unkeyed = {};
};

/// Words of an enum in the order of its values 0, 1, ...; specialised beside the field lists.
template <class Enum>
inline constexpr int kNames = 0;

/// T or const T: lets one field list serve readers and writers.
template <class S, class T>
concept Of = std::same_as<std::remove_const_t<S>, T>;

struct AnyVisitor {
  void operator()(const Field&, auto&) const {}
};

/// A struct with a field list.
template <class T>
concept Section = requires(T& section) {
  fields(AnyVisitor{}, section);
};

template <class T>
inline constexpr bool is_variant = false;
template <class... Kinds>
inline constexpr bool is_variant<std::variant<Kinds...>> = true;

/// A choice between sections, written `{kind: {...}}`.
template <class T>
concept Choice = is_variant<std::remove_const_t<T>>;

}  // namespace mapscore::eval
