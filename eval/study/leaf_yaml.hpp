// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/parameters.hpp"
#include "eval/study/study.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace mapscore::eval {

/// How a leaf of type T stands in a study file:
///   read(at, range)   its value; throws Error when the type or the range is wrong
///   text(value)       one canonical line of YAML that reads back as the same value
///   type()            its type for people
template <class T>
struct Leaf;

template <>
struct Leaf<double> {
  [[nodiscard]] static double read(const YamlValue& at, const Range& range);
  [[nodiscard]] static std::string text(double value) { return fmt::format("{}", value); }
  [[nodiscard]] static std::string type() { return "number"; }
};

template <>
struct Leaf<Degrees> : Leaf<double> {
  [[nodiscard]] static Degrees read(const YamlValue& at, const Range& range) {
    return {Leaf<double>::read(at, range)};
  }
  [[nodiscard]] static std::string text(Degrees value) { return Leaf<double>::text(value.deg); }
};

template <class T>
concept WholeNumber = std::same_as<T, int> || std::same_as<T, std::uint64_t>;

template <WholeNumber Number>
struct Leaf<Number> {
  [[nodiscard]] static Number read(const YamlValue& at, const Range& range);
  [[nodiscard]] static std::string text(Number value) { return fmt::format("{}", value); }
  [[nodiscard]] static std::string type() { return "whole number"; }
};

template <>
struct Leaf<bool> {
  [[nodiscard]] static bool read(const YamlValue& at, const Range&) {
    (void)at.plain_scalar("true or false");
    return at.boolean();
  }
  [[nodiscard]] static std::string text(bool value) { return value ? "true" : "false"; }
  [[nodiscard]] static std::string type() { return "true, false"; }
};

template <>
struct Leaf<std::string> {
  [[nodiscard]] static std::string read(const YamlValue& at, const Range&);
  [[nodiscard]] static std::string text(const std::string& value) { return yaml_text(value); }
  [[nodiscard]] static std::string type() { return "text"; }
};

/// A number, or `auto`.
template <>
struct Leaf<AutoNumber> {
  [[nodiscard]] static AutoNumber read(const YamlValue& at, const Range& range) {
    if (at.scalar("a number or auto") == "auto") return {};  // in quotes too, as JSON has words
    return {Leaf<double>::read(at, range)};
  }
  [[nodiscard]] static std::string text(const AutoNumber& number) {
    return number.value ? Leaf<double>::text(*number.value) : "auto";
  }
  [[nodiscard]] static std::string type() { return "number or auto"; }
};

/// A list of class names, or `all`.
template <>
struct Leaf<DetectedSet> {
  [[nodiscard]] static DetectedSet read(const YamlValue& at, const Range&);
  [[nodiscard]] static std::string text(const DetectedSet& detected);
  [[nodiscard]] static std::string type() { return "list of text, or all"; }
};

/// Texts by name; none is absent.
template <>
struct Leaf<ClassTitles> {
  [[nodiscard]] static ClassTitles read(const YamlValue& at, const Range&);
  [[nodiscard]] static std::string text(const ClassTitles& titles);
  [[nodiscard]] static std::string type() { return "{name: text}"; }
};

template <class Enum>
requires std::is_enum_v<Enum>
struct Leaf<Enum> {
  [[nodiscard]] static Enum read(const YamlValue& at, const Range&) {
    const std::string word = at.scalar("one of " + type());
    constexpr auto names = names_of(Enum{});
    for (std::size_t i = 0; i < names.size(); ++i)
      if (word == names[i]) return static_cast<Enum>(i);
    at.ask_for("one of " + type());
  }
  [[nodiscard]] static std::string text(Enum value) { return std::string(word_of(value)); }
  [[nodiscard]] static std::string type() {
    return fmt::format("{}", fmt::join(names_of(Enum{}), ", "));
  }
};

/// "[a, b]" from the leaves of a list or an array.
template <class List>
[[nodiscard]] std::string list_text(const List& list) {
  std::string result = "[";
  for (const auto& element : list) {
    if (result.size() > 1) result += ", ";
    result += Leaf<std::remove_cvref_t<decltype(element)>>::text(element);
  }
  return result + ']';
}

template <class T, std::size_t N>
struct Leaf<std::array<T, N>> {
  [[nodiscard]] static std::array<T, N> read(const YamlValue& at, const Range& range) {
    const std::vector<YamlValue> elements = at.elements();
    if (elements.size() != N)
      at.fail(fmt::format("has {} elements; write {}", elements.size(), type()));
    std::array<T, N> result{};
    for (std::size_t i = 0; i < N; ++i) result[i] = Leaf<T>::read(elements[i], range);
    return result;
  }
  [[nodiscard]] static std::string text(const std::array<T, N>& value) { return list_text(value); }
  [[nodiscard]] static std::string type() { return fmt::format("[{} x {}]", N, Leaf<T>::type()); }
};

template <class T>
struct Leaf<std::vector<T>> {
  [[nodiscard]] static std::vector<T> read(const YamlValue& at, const Range& range) {
    std::vector<T> result;
    for (const YamlValue& element : at.elements()) result.push_back(Leaf<T>::read(element, range));
    return result;
  }
  [[nodiscard]] static std::string text(const std::vector<T>& value) { return list_text(value); }
  [[nodiscard]] static std::string type() { return "list of " + Leaf<T>::type(); }
};

/// Absent is "-", which the dumper leaves out of the file.
template <class T>
struct Leaf<std::optional<T>> : Leaf<T> {
  [[nodiscard]] static std::string text(const std::optional<T>& value) {
    return value ? Leaf<T>::text(*value) : "-";
  }
};

/// Absent where it is not given, as an optional one.
template <class T, class Keys>
struct Leaf<Given<T, Keys>> : Leaf<std::remove_const_t<T>> {
  [[nodiscard]] static std::string text(const Given<T, Keys>& leaf) {
    return leaf.is_given() ? Leaf<std::remove_const_t<T>>::text(leaf.value) : "-";
  }
};

template <class List>
struct Leaf<UnlessEmpty<List>> : Leaf<std::remove_const_t<List>> {
  [[nodiscard]] static std::string text(const UnlessEmpty<List>& leaf) {
    return leaf.list.empty() ? "-" : Leaf<std::remove_const_t<List>>::text(leaf.list);
  }
};

/// Sets a leaf from YAML. Throws Error when the type or the range is wrong.
template <class T>
void read_leaf(const YamlValue& at, const Range& range, T& leaf) {
  leaf = Leaf<T>::read(at, range);
}
template <class T, class Keys>
void read_leaf(const YamlValue& at, const Range& range, Given<T, Keys>& leaf) {
  leaf.give(Leaf<T>::read(at, range));
}
template <class List>
void read_leaf(const YamlValue& at, const Range& range, UnlessEmpty<List>& leaf) {
  leaf.list = Leaf<List>::read(at, range);
  if (leaf.list.empty()) at.fail("is empty; write its numbers, or leave the key out");
}

}  // namespace mapscore::eval
