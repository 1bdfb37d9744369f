// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/leaf_yaml.hpp"
#include "eval/study/study.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace mapscore::eval {

// A study is a tree: sections, choices between sections, methods by name, the sweep, and leaves.
// These templates walk it; each node type is one branch.

using Methods = std::vector<MethodSettings>;
using Sweep = std::vector<SweepAxis>;

[[nodiscard]] std::vector<std::string> keys_of(const Section auto& section) {
  std::vector<std::string> keys;
  std::remove_cvref_t<decltype(section)>::fields(
      section, [&](const auto&, const Field& field) { keys.emplace_back(field.key); });
  return keys;
}

// --- reading -------------------------------------------------------------------------------------

/// Sets `value` from YAML; absent keys keep their defaults. Does not read the sweep, whose values
/// can be checked only when all leaves that it names are read. Throws Error.
template <class T>
void read_tree(const YamlValue& at, const Field& field, T& value);

template <Section T>
void read_section(const YamlValue& at, T& section) {
  at.only(keys_of(section));
  const auto entries = at.entries();
  const auto read_field = [&](auto& member, const Field& field) {
    for (const auto& [key, child] : entries) {
      if (key == field.key) return read_tree(child, field, member);
    }
    if (field.required) at.fail(fmt::format("'{0}' is missing; write {0}: ...", field.key));
  };
  T::fields(section, read_field);
}

template <class Kind>
bool read_kind(const std::pair<std::string, YamlValue>& entry, Choice auto& choice) {
  if (entry.first != Kind::kKind) return false;
  Kind section;
  read_section(entry.second, section);
  choice = section;
  return true;
}

template <class Kind>
bool take_kind(const std::string& name, Choice auto& choice) {
  if (name == Kind::kKind) choice = Kind{};
  return name == Kind::kKind;
}

/// `{kind: {...}}`, or the kind's name alone for its defaults.
template <class... Kinds>
void read_choice(const YamlValue& at, std::variant<Kinds...>& choice) {
  const std::vector<std::string> kinds = kinds_of(choice);
  if (at.node.IsScalar() && (take_kind<Kinds>(at.node.Scalar(), choice) || ...)) return;
  const auto entries = at.entries();
  if (entries.size() != 1) {
    at.fail(fmt::format("names {} kinds; write one of {}, as {{{}: {{}}}}", entries.size(),
                        fmt::join(kinds, ", "), kinds.front()));
  }
  if (!(read_kind<Kinds>(entries[0], choice) || ...)) {
    entries[0].second.fail(fmt::format("unknown kind '{}'; {}", entries[0].first,
                                       suggestion(entries[0].first, kinds)));
  }
}

/// Throws Error when the name cannot be a part of a dotted path.
void check_method_name(const YamlValue& at, const std::string& name);

inline void read_methods(const YamlValue& at, Methods& methods) {
  methods.clear();
  for (const auto& [name, child] : at.entries()) {
    check_method_name(child, name);
    methods.emplace_back().name = name;
    read_section(child, methods.back());
  }
}

template <class T>
void read_tree(const YamlValue& at, const Field& field, T& value) {
  if constexpr (std::same_as<T, Methods>) {
    read_methods(at, value);
  } else if constexpr (Choice<T>) {
    read_choice(at, value);
  } else if constexpr (Section<T>) {
    read_section(at, value);
  } else if constexpr (!std::same_as<T, Sweep>) {
    read_leaf(at, field.range, value);
  }
}

// --- one leaf ------------------------------------------------------------------------------------

/// Calls act(field, leaf) for the leaf at the dotted path `rest` below `value`. If the path ends at
/// a choice and `act` has a member choice, calls act.choice(choice) instead. Throws Error, with the
/// place `at`, when `rest` names no leaf.
template <class T, class Act>
void at_leaf(const YamlValue& at, const Field& field, T& value, std::string_view rest,
             const Act& act);

/// "head.tail" -> head, tail.
[[nodiscard]] inline std::pair<std::string_view, std::string_view> split_path(
    std::string_view path) {
  const std::size_t dot = std::min(path.find('.'), path.size());
  return {path.substr(0, dot), path.substr(std::min(dot + 1, path.size()))};
}

/// Throws Error when the path ends at something that has keys of its own, or goes on with none of
/// them.
[[noreturn]] inline void fail_on_key(const YamlValue& at, std::string_view key,
                                     const std::vector<std::string>& keys) {
  if (key.empty()) {
    at.fail(
        fmt::format("is a section, not a value; name a key below it: {}", fmt::join(keys, ", ")));
  }
  at.fail(fmt::format("unknown key '{}'; {}", key, suggestion(key, keys)));
}

template <class T, class Act>
void at_section_leaf(const YamlValue& at, T& section, std::string_view path, const Act& act) {
  const auto [head, tail] = split_path(path);
  bool found = false;
  const auto try_field = [&, head = head, tail = tail](auto& member, const Field& field) {
    if (field.key != head) return;
    found = true;
    at_leaf(at, field, member, tail, act);
  };
  std::remove_const_t<T>::fields(section, try_field);
  if (!found) fail_on_key(at, head, keys_of(section));
}

template <class T, class Act>
void at_choice_leaf(const YamlValue& at, T& choice, std::string_view path, const Act& act) {
  const auto [head, tail] = split_path(path);
  const auto try_kind = [&, head = head, tail = tail](auto& section) {
    if (head != section.kKind) fail_on_key(at, head, {std::string(section.kKind)});
    at_section_leaf(at, section, tail, act);
  };
  std::visit(try_kind, choice);
}

template <class T, class Act>
void at_method_leaf(const YamlValue& at, T& methods, std::string_view path, const Act& act) {
  const auto [head, tail] = split_path(path);
  std::vector<std::string> names;
  for (auto& method : methods) {
    if (method.name == head) return at_section_leaf(at, method, tail, act);
    names.push_back(method.name);
  }
  fail_on_key(at, head, names);
}

template <class T, class Act>
void at_leaf(const YamlValue& at, const Field& field, T& value, std::string_view rest,
             const Act& act) {
  using Plain = std::remove_const_t<T>;
  if constexpr (requires { act.choice(value); })
    if (rest.empty()) return act.choice(value);
  if constexpr (std::same_as<Plain, Methods>) {
    at_method_leaf(at, value, rest, act);
  } else if constexpr (std::same_as<Plain, Sweep>) {
    at.fail("the sweep is not a leaf; change it in the file or by a flag sweep.PATH=[...]");
  } else if constexpr (Choice<T>) {
    at_choice_leaf(at, value, rest, act);
  } else if constexpr (Section<T>) {
    at_section_leaf(at, value, rest, act);
  } else {
    if (!rest.empty())
      at.fail(
          fmt::format("'{}' is a value and has no key '{}'; end the path there", field.key, rest));
    act(field, value);
  }
}

/// As set_leaf of study.hpp, from a value whose place is known.
void set_leaf(Study& study, std::string_view path, const YamlValue& at);

}  // namespace mapscore::eval
