// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/leaf_yaml.hpp"
#include "files/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <functional>
#include <optional>
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
using Scenes = std::vector<SceneSettings>;

/// Lists of settings by name or path that have no leaves of their own.
template <class T>
concept Listing = std::same_as<T, Sweep> || std::same_as<T, Scenes>;

/// What has keys.
template <class T>
concept Node = Section<T> || Choice<T> || std::same_as<std::remove_const_t<T>, Methods>;

/// Calls visit(child, field) for each field of a section, the kind of a choice, each method.
template <Node T>
void for_each_child(T& node, const auto& visit) {
  if constexpr (Choice<T>)
    std::visit([&](auto& kind) { visit(kind, Field{kind.kKind, kind.kMeaning}); }, node);
  else if constexpr (Section<T>)
    std::remove_const_t<T>::fields(node, visit);
  else
    for (auto& method : node) visit(method, Field{method.name, ""});
}

[[nodiscard]] std::vector<std::string> keys_of(const Node auto& node) {
  std::vector<std::string> keys;
  for_each_child(node, [&](const auto&, const Field& field) { keys.emplace_back(field.key); });
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
    for (const auto& [key, child] : entries)
      if (key == field.key) return read_tree(child, field, member);
    if (field.required) at.fail(fmt::format("'{0}' is missing; write {0}: ...", field.key));
  };
  T::fields(section, read_field);
}

/// The kind of that name with its defaults; none where there is no such kind.
template <Choice Any>
std::optional<Any> kind_named(std::string_view name) {
  for (const Any& kind : each_kind<Any>())
    if (kind_of(kind) == name) return kind;
  return std::nullopt;
}

/// `{kind: {...}}`, or the kind's name alone for its defaults.
template <Choice Any>
void read_choice(const YamlValue& at, Any& choice) {
  const std::vector<std::string> kinds = kinds_of(choice);
  if (at.node.IsScalar()) {
    const std::string name = at.node.Scalar();
    if (const auto plain = kind_named<Any>(name)) return void(choice = *plain);
    at.fail(fmt::format("unknown kind '{}'; {}", name, suggestion(name, kinds)));
  }
  const auto entries = at.entries();
  if (entries.size() != 1)
    at.fail(fmt::format("names {} kinds; write one of {}, as {{{}: {{}}}}", entries.size(),
                        fmt::join(kinds, ", "), kinds.front()));
  const auto& [name, section] = entries[0];
  auto read = kind_named<Any>(name);
  if (!read) section.fail(fmt::format("unknown kind '{}'; {}", name, suggestion(name, kinds)));
  std::visit([&from = section](auto& kind) { read_section(from, kind); }, *read);
  choice = *read;
}

/// Throws Error when the name of a method or a scene cannot be a part of a dotted path.
void check_word(const YamlValue& at, const std::string& name, const char* of);

/// Reads scenes, whose keys are those of a recording. Throws Error.
void read_scenes(const YamlValue& at, Scenes& scenes);

inline void read_methods(const YamlValue& at, Methods& methods) {
  methods.clear();
  for (const auto& [name, child] : at.entries()) {
    check_word(child, name, "method");
    methods.emplace_back().name = name;
    if (child.has("command")) methods.back().command.emplace();
    read_section(child, methods.back());
  }
}

template <class T>
void read_tree(const YamlValue& at, const Field& field, T& value) {
  if constexpr (std::same_as<T, Methods>) {
    read_methods(at, value);
  } else if constexpr (std::same_as<T, Scenes>) {
    read_scenes(at, value);
  } else if constexpr (Choice<T>) {
    read_choice(at, value);
  } else if constexpr (Section<T>) {
    read_section(at, value);
  } else if constexpr (!std::same_as<T, Sweep>) {
    read_leaf(at, field.range, value);
  }
}

// --- one leaf ------------------------------------------------------------------------------------

/// A leaf or a choice that a path leads to, whatever its type, so that the tree is compiled once
/// for all that is done with its leaves.
struct StudyLeaf {
  const Field& field;
  const std::function<void(const YamlValue&)>& read;  ///< sets it; throws Error
  const std::function<std::string()>& text;           ///< of a choice its kind
  bool whole = false;                                 ///< a whole number
  bool choice = false;
};
using LeafAct = std::function<void(const StudyLeaf&)>;

/// Calls act(leaf) for what stands at the dotted path `rest` below `value`. Throws Error, with the
/// place `at`, when `rest` names no leaf and no choice.
template <class T>
void at_leaf(const YamlValue& at, const Field& field, T& value, std::string_view rest,
             const LeafAct& act);

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
  if (key.empty())
    at.fail(
        fmt::format("is a section, not a value; name a key below it: {}", fmt::join(keys, ", ")));
  at.fail(fmt::format("unknown key '{}'; {}", key, suggestion(key, keys)));
}

template <Node T>
void at_leaf_below(const YamlValue& at, T& node, std::string_view path, const LeafAct& act) {
  const auto [head, tail] = split_path(path);
  bool found = false;
  for_each_child(node, [&, head = head, tail = tail](auto& child, const Field& field) {
    if (field.key != head) return;
    found = true;
    at_leaf(at, field, child, tail, act);
  });
  if (found) return;
  if constexpr (Choice<T>)
    if (kind_named<T>(head))
      at.fail(
          fmt::format("the kind here is '{}', not '{}'; choose it as a whole, as {{{}: {{...}}}}",
                      kind_of(node), head, head));
  fail_on_key(at, head, keys_of(node));
}

template <class T>
void at_leaf(const YamlValue& at, const Field& field, T& value, std::string_view rest,
             const LeafAct& act) {
  if constexpr (Choice<T>)
    if (rest.empty())
      return act({field, [&](const YamlValue& yaml) { read_choice(yaml, value); },
                  [&] { return std::string(kind_of(value)); }, false, true});
  if constexpr (Listing<T>) {
    at.fail(fmt::format("the {} is not a leaf; change it in the file or by a flag sweep.PATH=[...]",
                        field.key));
  } else if constexpr (Node<T>) {
    at_leaf_below(at, value, rest, act);
  } else {
    if (!rest.empty())
      at.fail(
          fmt::format("'{}' is a value and has no key '{}'; end the path there", field.key, rest));
    act({field, [&](const YamlValue& yaml) { read_leaf(yaml, field.range, value); },
         [&] { return Leaf<T>::text(value); }, Leaf<T>::type() == Leaf<int>::type()});
  }
}

/// As set_leaf and set_dose of study.hpp, from a value whose place is known.
void set_leaf(Study& study, std::string_view path, const YamlValue& at);
void set_dose(Study& study, std::string_view path, const YamlValue& at);

}  // namespace mapscore::eval
