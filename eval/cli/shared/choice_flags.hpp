// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "core/parameters.hpp"
#include "eval/study/leaf_yaml.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mapscore::eval {

/// Flags of a choice between kinds: one that names the kind, and one for each parameter of the
/// kinds, which kinds share that name it alike. Must stay where it is until the flags are parsed.
template <Choice Any>
class ChoiceFlags {
 public:
  /// `start`: the choice where no flag is given; its parameters are the defaults of its kind.
  ChoiceFlags(std::string flag, Any start) : flag_(std::move(flag)), start_(std::move(start)) {}
  ChoiceFlags(const ChoiceFlags&) = delete;
  ChoiceFlags& operator=(const ChoiceFlags&) = delete;

  void add_to(CLI::App& verb, const std::string& group = "Options") {
    const std::vector<std::string> kinds = kinds_of(start_);
    verb.add_option(flag_, kind_, fmt::format("{} [{}]", fmt::join(kinds, ", "), kind_of(start_)))
        ->group(group)
        ->check(CLI::IsMember(kinds));
    for (const Any& kind : each_kind<Any>())
      std::visit([&](const auto& of_kind) { add_parameters(verb, of_kind, group); },
                 kind_of(kind) == kind_of(start_) ? start_ : kind);
  }

  /// Whether any of the flags was given.
  [[nodiscard]] bool given() const {
    return !kind_.empty() || std::ranges::any_of(parameters_, [](const auto& entry) {
      return entry.second.is_given();
    });
  }

  /// The choice. Throws Error, naming the flag, on a value out of its range and on a parameter of
  /// another kind, which would have no effect.
  [[nodiscard]] Any value() const {
    Any chosen = start_;
    for (const Any& kind : each_kind<Any>())
      if (!kind_.empty() && kind_ != kind_of(start_) && kind_of(kind) == kind_) chosen = kind;
    for (const auto& [key, parameter] : parameters_)
      if (parameter.is_given() && !parameter.refusals.contains(std::string(kind_of(chosen))))
        throw Error(fmt::format("--{}: belongs to {} {}; leave it out of {}", key, flag_,
                                parameter.refusals.begin()->first, kind_of(chosen)));
    std::visit([this](auto& kind) { read_parameters(kind); }, chosen);
    return chosen;
  }

 private:
  struct Parameter {
    CLI::Option* option = nullptr;
    std::optional<std::string> text;
    bool flag = false;
    /// By kind: why a text is no value; empty where it is one.
    std::map<std::string, std::function<std::string(const std::string&)>> refusals;

    [[nodiscard]] bool is_given() const { return flag || text; }

    /// Empty where the text is a value for some kind.
    [[nodiscard]] std::string refusal(const std::string& value) const {
      std::string last;
      for (const auto& [kind, refusal_of] : refusals)
        if ((last = refusal_of(value)).empty()) return last;
      return last;
    }
  };

  template <class Kind>
  void add_parameters(CLI::App& verb, const Kind& kind, const std::string& group) {
    Kind::fields(kind, [&]<class T>(const T& member, const Field& field) {
      const std::string key(field.key), name = "--" + key;
      Parameter& parameter = parameters_[key];
      parameter.refusals[std::string(Kind::kKind)] = [=](const std::string& text) {
        return refusal(name, field, text, member);
      };
      const std::string help =
          fmt::format("Of {}: {} [{}]", Kind::kKind, field.meaning, Leaf<T>::text(member));
      if (parameter.option)
        parameter.option->description(parameter.option->get_description() + "\n" + help);
      else if constexpr (std::same_as<T, bool>)
        parameter.option = verb.add_flag(name, parameter.flag, help)->group(group);
      else
        parameter.option =
            verb.add_option(name, parameter.text, help)
                ->group(group)
                ->check(CLI::Validator(
                    [&parameter](const std::string& text) { return parameter.refusal(text); }, ""));
    });
  }

  /// Why a text is no value of a field; empty where it is one.
  template <class T>
  static std::string refusal(const std::string& name, const Field& field, const std::string& text,
                             T probe) {
    try {
      read_leaf(parse_yaml_value(text, "", name), field.range, probe);
      return "";
    } catch (const Error& error) {
      const std::string why = error.what(), prefix = name + ": ";
      return why.starts_with(prefix) ? why.substr(prefix.size()) : why;  // CLI11 names the flag
    }
  }

  template <class Kind>
  void read_parameters(Kind& kind) const {
    Kind::fields(kind, [&]<class T>(T& member, const Field& field) {
      const Parameter& parameter = parameters_.at(std::string(field.key));
      if (!parameter.is_given()) return;
      const std::string text = parameter.flag ? "true" : *parameter.text;
      read_leaf(parse_yaml_value(text, "", fmt::format("--{}", field.key)), field.range, member);
    });
  }

  std::string flag_, kind_;
  Any start_;
  std::map<std::string, Parameter> parameters_;  ///< by key, of all kinds
};

}  // namespace mapscore::eval
