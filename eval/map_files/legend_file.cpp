// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/legend.hpp"
#include "eval/map_files/refusal.hpp"
#include "eval/map_files/text_rows.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/yaml_value.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

namespace mapscore::eval {
namespace {

std::optional<std::uint32_t> colour_of(const std::string& text) {
  std::uint32_t colour = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, colour, 16);
  if (text.size() != 6 || error != std::errc() || stop != end) return std::nullopt;
  return colour;
}

std::optional<std::uint32_t> id_of(const std::string& text) {
  const auto id = parse_whole(text);
  if (!id || *id < std::numeric_limits<std::int32_t>::min() ||
      *id > std::numeric_limits<std::uint32_t>::max())
    return std::nullopt;
  return static_cast<std::uint32_t>(*id);
}

std::optional<std::string> name_of(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// Reader of one legend; knows its file for the errors.
class LegendReader {
 public:
  LegendReader(const std::filesystem::path& file, const ClassTable& table)
      : file_(file), table_(table) {}

  Legend read() {
    const YAML::Node root = load();
    if (!root.IsMap()) fail(root, "expected the sections colours, ids or names");
    Legend legend;
    std::set<std::string> seen;
    for (const auto& section : root) {
      const std::string key = scalar(section.first);
      if (!seen.insert(key).second)
        fail(section.first, fmt::format("section {} stands twice; keep one", shown(key)));
      if (key == "colours")
        take(section.second, legend.colours, colour_of, "six hexadecimal digits in quotes");
      else if (key == "ids")
        take(section.second, legend.ids, id_of, "a whole number of 32 bits");
      else if (key == "names")
        take(section.second, legend.names, name_of, "a name");
      else
        fail(section.first,
             fmt::format("unknown section {}; known are colours, ids, names", shown(key)));
    }
    if (!names_a_class_) fail(root, "the legend names no class; give one of " + valid_classes());
    return legend;
  }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    refuse(file_, static_cast<std::size_t>(std::max(mark.line, 0)) + 1, what);
  }
  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    fail(node.Mark(), what);
  }

  [[nodiscard]] YAML::Node load() const {
    try {
      const std::string text = read_file(file_);
      refuse_large_yaml(text, file_.string());
      return YAML::Load(text);
    } catch (const YAML::Exception& error) {
      fail(error.mark,
           fmt::format("broken YAML ({}); mend the syntax near here", shown(error.msg)));
    }
  }

  [[nodiscard]] std::string scalar(const YAML::Node& node) const {
    if (!node.IsScalar()) fail(node, "expected one word");
    return node.Scalar();
  }

  /// Entries `label: class` of one section.
  template <class Map, class Parse>
  void take(const YAML::Node& section, Map& entries, Parse parse, const char* wanted) {
    if (!section.IsMap()) fail(section, "expected entries label: class");
    for (const auto& entry : section) {
      const std::string text = scalar(entry.first);
      const auto label = parse(text);
      if (!label) fail(entry.first, fmt::format("{} is not {}", shown(text), wanted));
      if (!entries.emplace(*label, class_of(entry.second)).second)
        fail(entry.first, fmt::format("{} stands twice; keep one", shown(text)));
    }
  }

  [[nodiscard]] ClassId class_of(const YAML::Node& node) {
    const std::string name = scalar(node);
    const auto found = std::ranges::find(table_.classes, name, &SemanticClass::name);
    if (found == table_.classes.end())
      fail(node, fmt::format("the truth has no class {}; its classes are {}", shown(name),
                             valid_classes()));
    names_a_class_ = names_a_class_ || found->id != kBackground;
    return found->id;
  }

  [[nodiscard]] std::string valid_classes() const {
    std::vector<std::string> names;
    for (const SemanticClass& c : table_.classes) names.push_back(c.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  const std::filesystem::path& file_;
  const ClassTable& table_;
  bool names_a_class_ = false;
};

}  // namespace

Legend read_legend(const std::filesystem::path& file, const ClassTable& table) {
  return LegendReader(file, table).read();
}

}  // namespace mapscore::eval
