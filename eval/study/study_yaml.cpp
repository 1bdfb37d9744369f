// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/study/study_tree.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace mapscore::eval {
namespace {

/// Writes a tree of settings in block style, leaves on one line each.
class Dumper {
 public:
  /// `for_key`: leave out what is `later` and has its default.
  /// `keys`: those of the study itself that are written; empty: all.
  explicit Dumper(bool for_key, std::set<std::string_view> keys = {})
      : for_key_(for_key), keys_(std::move(keys)) {}

  template <Node T>
  void body(const T& node) {
    static const std::map<std::string_view, std::string> defaults = default_texts<T>();
    for_each_child(node, [this](const auto& child, const Field& field) {
      if (depth_ == 0 && !keys_.empty() && !keys_.contains(field.key)) return;
      const auto plain = defaults.find(field.key);
      this->key(field, child, plain == defaults.end() ? "" : plain->second);
    });
  }

  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  /// What a younger member says at its default: its text, its kind, or `{}`.
  template <class T>
  static std::map<std::string_view, std::string> default_texts() {
    std::map<std::string_view, std::string> texts;
    const T plain{};
    for_each_child(plain, [&]<class M>(const M& member, const Field& field) {
      if (!field.later) return;
      if constexpr (Choice<M>)
        texts[field.key] = kind_of(member);
      else if constexpr (Section<const M>)
        texts[field.key] = "{}";
      else if constexpr (!std::same_as<M, Methods> && !Listing<M>)
        texts[field.key] = Leaf<M>::text(member);
    });
    return texts;
  }

  /// `plain`: text that a key leaves out; empty: none.
  template <class T>
  void key(const Field& field, const T& value, std::string_view plain) {
    if constexpr (std::same_as<T, Scenes>)
      if (value.empty()) return;
    if constexpr (Node<const T> || Listing<T>) {
      if constexpr (Choice<T>)
        if (!is_written(kind_of(value), plain)) return;
      nest(field, plain, [&] { body(value); });
    } else if (const std::string leaf = Leaf<T>::text(value); is_written(leaf, plain)) {
      line(fmt::format("{}: {}", field.key, leaf));
    }
  }

  [[nodiscard]] bool is_written(std::string_view leaf, std::string_view plain) const {
    return leaf != "-" && !(for_key_ && leaf == plain);
  }

  void body(const Sweep& sweep) {
    for (const SweepAxis& axis : sweep)
      line(fmt::format("{}: [{}]", axis.path, fmt::join(axis.values, ", ")));
  }

  void body(const Scenes& scenes) {
    for (const SceneSettings& scene : scenes) {
      line(fmt::format("{}:", scene.name));
      ++depth_;
      for (const auto& [path, text] : scene.leaves) line(fmt::format("{}: {}", path, text));
      --depth_;
    }
  }

  /// "key:" over an indented body, or "key: {}" where the body is empty.
  void nest(const Field& field, std::string_view plain, const auto& write_body) {
    const std::size_t start = text_.size();
    line(fmt::format("{}:", field.key));
    const std::size_t before = text_.size();
    ++depth_;
    write_body();
    --depth_;
    if (text_.size() > before) return;
    text_.insert(before - 1, " {}");
    if (!is_written("{}", plain)) text_.resize(start);
  }

  void line(std::string_view content) {
    text_.append(2 * static_cast<std::size_t>(depth_), ' ').append(content) += '\n';
  }

  bool for_key_;
  std::set<std::string_view> keys_;
  std::string text_;
  int depth_ = 0;
};

std::string yaml_of(const Study& study, bool for_key) {
  Dumper dumper(for_key);
  dumper.body(study);
  return std::move(dumper).take();
}

template <class T>
void add_leaves(const std::string& path, const T& value,
                std::map<std::string, std::string>& leaves) {
  if constexpr (Choice<T>) leaves[path] = kind_of(value);
  if constexpr (Node<const T>)
    for_each_child(value, [&](const auto& child, const Field& field) {
      add_leaves(path.empty() ? std::string(field.key) : fmt::format("{}.{}", path, field.key),
                 child, leaves);
    });
  else if constexpr (!Listing<T>)
    leaves[path] = Leaf<T>::text(value);
}

}  // namespace

std::map<std::string, std::string> leaf_texts(const Study& study) {
  std::map<std::string, std::string> leaves;
  add_leaves("", study, leaves);
  std::erase_if(leaves, [](const auto& leaf) { return leaf.second == "-"; });
  return leaves;
}

std::string whole_path(const Study& study, const std::string& name) {
  const std::vector<std::string> first_keys = keys_of(study);
  if (std::ranges::count(first_keys, split_path(name).first) > 0) return name;
  std::map<std::string, std::string> leaves;
  add_leaves("", study, leaves);
  std::vector<std::string> paths;
  for (const auto& [path, text] : leaves) paths.push_back(path);
  const auto path = path_named(name, paths);
  if (!path &&
      std::ranges::any_of(paths, [&](const std::string& of) { return of.ends_with('.' + name); }))
    throw Error(fmt::format("{}: may be several keys; {}", name, suggestion(name, paths)));
  return path.value_or(name);
}

std::string to_yaml(const Study& study) {
  return yaml_of(study, false);
}

std::string method_yaml(const Study& config) {
  Study alone = config;
  alone.name = config.methods.front().name;
  alone.recording = ".";
  Dumper dumper(false, {"name", "recording", "voxel_m", "place", "methods", "fusion", "occupancy"});
  dumper.body(alone);
  return std::move(dumper).take();
}

std::string to_key_yaml(const Study& study) {
  return yaml_of(study, true);
}

}  // namespace mapscore::eval
