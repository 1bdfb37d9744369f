// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace mapscore {

// A parameter is written once: in the struct of the algorithm that uses it, with its default, and
// in the list of fields of that struct, with its range and its meaning:
//
//   struct Erosion {
//     static constexpr std::string_view kKind = "erosion", kMeaning = "erode the mask";
//     int radius_px = 5;
//     static void fields(auto& s, auto&& visit) {
//       visit(s.radius_px, Field{"radius_px", "radius of the eroding disc", {0, 1000}});
//     }
//   };
//
// Study files, `--set`, flags, sweeps, keys of results, the page of all keys and the axes of
// figures visit these lists. This header depends on neither YAML nor flags.

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

/// What there is to know of one parameter besides its type and its default.
struct Field {
  std::string_view key;          ///< as in files and flags; its ending is its unit (_m, _deg, _px)
  std::string_view meaning;      ///< for people
  Range range = {};              ///< of each number of it
  std::string_view figure = {};  ///< name and unit on the axis of a figure: "mount error (mm)"
  bool dose = false;             ///< multiplied by the `scale` of a preset (Dosed)
  /// Younger than the first stored results: left out of a result's key where it has its default,
  /// so that older results keep their keys.
  bool later = false;
  bool required = false;  ///< has no default
  bool recorded = false;  ///< decides what a recording holds
  bool swept = true;      ///< may take several values in one study
};

/// The same field, marked as `later`.
[[nodiscard]] constexpr Field later(Field field) {
  field.later = true;
  return field;
}

/// An angle in degrees, as files have it to the bit, converted where it is used.
struct Degrees {
  double deg = 0;
  [[nodiscard]] double rad() const { return deg * (std::numbers::pi / 180.0); }
  bool operator==(const Degrees&) const = default;
};

// An enum's words, in the order of its values 0, 1, ..., stand beside it in an overload of
// names_of(Enum), which is found by its argument:
//
//   enum class Decay { hit, view };
//   constexpr auto names_of(Decay) { return std::to_array<std::string_view>({"hit", "view"}); }

/// The word of one of its values.
template <class Enum>
requires std::is_enum_v<Enum>
[[nodiscard]] constexpr std::string_view word_of(Enum value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

struct AnyVisitor {
  void operator()(auto&, const Field&) const {}
};

/// A struct with a list of fields.
template <class T>
concept Section = requires(T& section) {
  std::remove_const_t<T>::fields(section, AnyVisitor{});
};

/// Base of a section without parameters.
struct NoFields {
  static void fields(auto&, auto&&) {}
  bool operator==(const NoFields&) const = default;
};

template <class T>
inline constexpr bool is_variant = false;
template <class... Kinds>
inline constexpr bool is_variant<std::variant<Kinds...>> = true;

/// A choice between sections, each with a kKind and a kMeaning.
template <class T>
concept Choice = is_variant<std::remove_const_t<T>>;

/// One of each kind, with its defaults, in their order. Without the kind that a program may add
/// (plugged.hpp) where it adds none: its word is empty then.
template <Choice Any>
[[nodiscard]] std::vector<Any> each_kind() {
  std::vector<Any> kinds;
  [&kinds]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
    ((Kinds::kKind.empty() ? void() : void(kinds.emplace_back(std::in_place_type<Kinds>))), ...);
  }(std::type_identity<Any>{});
  return kinds;
}

/// The words of these kinds, in their order.
template <class... Kinds>
[[nodiscard]] std::vector<std::string> kinds_of(const std::variant<Kinds...>&) {
  std::vector<std::string> words{std::string(Kinds::kKind)...};
  std::erase(words, "");
  return words;
}

[[nodiscard]] std::string_view kind_of(const Choice auto& choice) {
  return std::visit([](const auto& kind) { return kind.kKind; }, choice);
}

/// Throws Error "what: is out of range; give a number ...".
[[noreturn]] void fail_out_of_range(std::string_view what, double value, const Range& range);

/// Throws Error naming the field whose number is not finite or lies outside of its range. A dose,
/// which may have been scaled, has no upper limit here.
template <Section T>
void check_ranges(const T& parameters) {
  T::fields(parameters, [](const auto& member, const Field& field) {
    using Member = std::remove_cvref_t<decltype(member)>;
    const auto check_number = [&field](double number) {
      Range range = field.range;
      if (field.dose) range.high = Range{}.high;
      if (!range.holds(number) || !std::isfinite(number))
        fail_out_of_range(field.key, number, field.range);
    };
    if constexpr (std::same_as<Member, Degrees>)
      check_number(member.deg);
    else if constexpr (std::same_as<Member, std::optional<double>>)
      member ? check_number(*member) : void();
    else if constexpr (std::is_arithmetic_v<Member> && !std::same_as<Member, bool>)
      check_number(static_cast<double>(member));
  });
}

/// Calls act(member of a, member of b, field) for the fields that both lists name, of equal types.
void for_common_fields(auto& a, auto& b, const auto& act) {
  using A = std::remove_cvref_t<decltype(a)>;
  using B = std::remove_cvref_t<decltype(b)>;
  A::fields(a, [&](auto& of_a, const Field& field) {
    B::fields(b, [&](auto& of_b, const Field& other) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(of_a)>,
                                 std::remove_cvref_t<decltype(of_b)>>)
        if (field.key == other.key) act(of_a, of_b, field);
    });
  });
}

/// A member that is written down only where it is given; else it has the value of another place.
template <class T, class Keys>
struct Given {
  T& value;
  Keys& keys;  ///< those that are given
  std::string_view key;

  [[nodiscard]] bool is_given() const { return keys.contains(key); }
  void give(const std::remove_const_t<T>& given) {
    value = given;
    keys.insert(key);
  }
};

/// A list whose key is left out of files where it is empty.
template <class List>
struct UnlessEmpty {
  List& list;
};

/// Parameters of T, of which a file gives some: the others are T's defaults, or those of a preset.
template <Section T>
struct Overrides {
  T values;  ///< what is not given has T's default
  std::set<std::string_view> given = {};

  static void fields(auto& s, auto&& visit) {
    T::fields(s.values, [&](auto& member, const Field& field) {
      Given member_if_given{member, s.given, field.key};
      visit(member_if_given, field);
    });
  }

  /// `others` with the given values in the place of their own, by key.
  template <Section Other>
  [[nodiscard]] Other over(Other others) const {
    for_common_fields(values, others, [&](const auto& own, auto& other, const Field& field) {
      if (given.contains(field.key)) other = own;
    });
    return others;
  }

  /// Gives what differs from `plain`, or everything.
  [[nodiscard]] static Overrides differing(const T& all, const T& plain) {
    Overrides result;
    for_common_fields(all, plain, [&](const auto& a, const auto& b, const Field& field) {
      if (!(a == b)) result.given.insert(field.key);
    });
    result.values = Overrides{all, result.given}.over(T{});
    return result;
  }
  [[nodiscard]] static Overrides everything(const T& all) {
    Overrides result{all};
    T::fields(all, [&](const auto&, const Field& field) { result.given.insert(field.key); });
    return result;
  }

  bool operator==(const Overrides&) const = default;
};

/// Multiplies every field that is a dose.
void scale_doses(auto& dose, double scale) {
  std::remove_cvref_t<decltype(dose)>::fields(dose, [scale](auto& member, const Field& field) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, double>)
      if (field.dose) member *= scale;
  });
}

/// A dose as a file gives it: a preset, single parameters that replace the preset's, and a factor
/// that multiplies every dose. `Dose` has an enum Preset with `ideal` first, of(Preset), and the
/// fields kPreset and kScale; scale_by(factor) if scaling concerns more than its fields.
template <class Dose>
struct Dosed {
  typename Dose::Preset preset{};
  double scale = 1;
  Overrides<Dose> own = {};

  static void fields(auto& s, auto&& visit) {
    visit(s.preset, Dose::kPreset);
    visit(s.scale, Dose::kScale);
    Overrides<Dose>::fields(s.own, visit);
  }

  /// The dose in numbers.
  [[nodiscard]] Dose dose() const {
    Dose dose = own.over(Dose::of(preset));
    if constexpr (requires { dose.scale_by(scale); })
      dose.scale_by(scale);
    else
      scale_doses(dose, scale);
    return dose;
  }

  bool operator==(const Dosed&) const = default;
};

/// The same dose without preset and scale: what differs from the ideal, and nothing where it is
/// zero. Equal doses have equal canonical forms.
template <class Dose>
[[nodiscard]] Dosed<Dose> canonical(const Dose& dose) {
  if (is_zero(dose)) return {};
  return {.own = Overrides<Dose>::differing(dose, Dose::of(typename Dose::Preset{}))};
}

}  // namespace mapscore
