// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/experiment/study_tree.hpp"

namespace mapscore::eval {
namespace {

/// Writes a tree of settings in block style, leaves on one line each.
class Dumper {
 public:
  /// `for_key`: leave out what Field::unkeyed tells.
  explicit Dumper(bool for_key) : for_key_(for_key) {}

  void section(const Section auto& value) {
    fields([this](const Field& field, const auto& member) { this->key(field, member); }, value);
  }

  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  template <class T>
  void key(const Field& field, const T& value) {
    if constexpr (Section<const T> || Choice<T> || std::same_as<T, Methods> ||
                  std::same_as<T, Sweep>) {
      if constexpr (Choice<T>)
        if (!is_written(field, kind_of(value))) return;
      nest(field, [&] { body(value); });
    } else if (const std::string leaf = Leaf<T>::text(value); is_written(field, leaf)) {
      line(fmt::format("{}: {}", field.key, leaf));
    }
  }

  [[nodiscard]] bool is_written(const Field& field, std::string_view leaf) const {
    return leaf != "-" && !(for_key_ && leaf == field.unkeyed);
  }

  void body(const Section auto& value) { section(value); }
  void body(const Choice auto& choice) {
    const auto write_kind = [this](const auto& kind) { this->key(Field{kind.kKind, ""}, kind); };
    std::visit(write_kind, choice);
  }
  void body(const Methods& methods) {
    for (const MethodSettings& method : methods) key(Field{method.name, ""}, method);
  }
  void body(const Sweep& sweep) {
    for (const SweepAxis& axis : sweep) {
      line(fmt::format("{}: [{}]", axis.path, fmt::join(axis.values, ", ")));
    }
  }

  /// "key:" over an indented body, or "key: {}" where the body is empty.
  void nest(const Field& field, const auto& write_body) {
    const std::size_t start = text_.size();
    line(fmt::format("{}:", field.key));
    const std::size_t before = text_.size();
    ++depth_;
    write_body();
    --depth_;
    if (text_.size() > before) return;
    text_.insert(before - 1, " {}");
    if (!is_written(field, "{}")) text_.resize(start);
  }

  void line(std::string_view content) {
    text_ += fmt::format("{:{}}{}\n", "", 2 * depth_, content);
  }

  bool for_key_;
  std::string text_;
  int depth_ = 0;
};

std::string yaml_of(const Study& study, bool for_key) {
  Dumper dumper(for_key);
  dumper.section(study);
  return std::move(dumper).take();
}

}  // namespace

std::string to_yaml(const Study& study) {
  return yaml_of(study, false);
}

std::string to_key_yaml(const Study& study) {
  return yaml_of(study, true);
}

}  // namespace mapscore::eval
