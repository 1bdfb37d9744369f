// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/legend.hpp"
#include "eval/map_files/refusal.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace mapscore::eval {
namespace {

std::uint32_t colour_of(const YamlValue& label) {
  const Colour colour = label.colour();
  return static_cast<std::uint32_t>(colour.r << 16 | colour.g << 8 | colour.b);
}

std::uint32_t id_of(const YamlValue& label) {
  const auto id = parse_whole(label.text());
  if (!id || *id < std::numeric_limits<std::int32_t>::min() ||
      *id > std::numeric_limits<std::uint32_t>::max())
    label.ask_for("a whole number of 32 bits");
  return static_cast<std::uint32_t>(*id);
}

std::string name_of(const YamlValue& label) {
  if (label.text().empty()) label.ask_for("a name");
  return label.text();
}

std::string names_of(const ClassTable& table) {
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes) names.push_back(c.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

ClassId class_of(const YamlValue& value, const ClassTable& table) {
  const std::string name = value.scalar("a class of the truth");
  const auto found = std::ranges::find(table.classes, name, &SemanticClass::name);
  if (found == table.classes.end())
    value.fail(
        fmt::format("the truth has no class {}; its classes are {}", shown(name), names_of(table)));
  return found->id;
}

/// Entries `label: class` of one section; `label_of` reads a label. Returns whether one names a
/// class.
template <class Map>
bool take(const YamlValue& root, const std::string& section, const ClassTable& table,
          typename Map::key_type (*label_of)(const YamlValue&), Map& classes) {
  if (!root.has(section)) return false;
  for (const auto& [text, value] : root.at(section).entries()) {
    const YamlValue label{YAML::Node(text), value.source, value.line, value.path};
    if (!classes.emplace(label_of(label), class_of(value, table)).second)
      label.fail(fmt::format("{} stands twice; keep one", shown(text)));
  }
  return std::ranges::any_of(classes,
                             [](const auto& entry) { return entry.second != kBackground; });
}

}  // namespace

Legend read_legend(const std::filesystem::path& file, const ClassTable& table) {
  const YamlValue root = load_yaml(file);
  root.only({"colours", "ids", "names"});
  Legend legend;
  bool names_a_class = take(root, "colours", table, colour_of, legend.colours);
  names_a_class |= take(root, "ids", table, id_of, legend.ids);
  names_a_class |= take(root, "names", table, name_of, legend.names);
  if (!names_a_class) root.fail("the legend names no class; give one of " + names_of(table));
  return legend;
}

}  // namespace mapscore::eval
