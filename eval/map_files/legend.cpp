// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/legend.hpp"

#include "core/error.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace mapscore::eval {
namespace {

std::uint32_t packed(const Colour& colour) {
  return static_cast<std::uint32_t>(colour.r << 16 | colour.g << 8 | colour.b);
}

std::uint32_t colour_of(const YamlValue& label) {
  return packed(label.colour());
}

std::uint32_t id_of(const YamlValue& label) {
  const auto id = parse_id(label.text());
  if (!id) label.ask_for("a whole number of 32 bits");
  return *id;
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

std::optional<ClassId> class_of_name(const std::string& name, const ClassTable& table) {
  const auto found = std::ranges::find(table.classes, name, &SemanticClass::name);
  return found == table.classes.end() ? std::nullopt : std::optional(found->id);
}

ClassId class_of(const YamlValue& value, const ClassTable& table) {
  const std::string name = value.scalar("a class of the truth");
  const auto found = class_of_name(name, table);
  if (!found)
    value.fail(fmt::format("the truth has no class {}; its classes are {}", excerpt(name),
                           names_of(table)));
  return *found;
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
      label.fail(fmt::format("{} stands twice; keep one", excerpt(text)));
  }
  return !classes.empty();
}

/// The label as a legend spells it.
std::string spelt(const MapFile& map, std::uint32_t label) {
  if (map.label_kind == LabelKind::colour) return fmt::format("{:06X}", label);
  if (map.label_kind == LabelKind::name) return map.names[label];
  return std::to_string(static_cast<std::int32_t>(label));
}

/// Class whose colour this is.
std::optional<ClassId> class_of_colour(std::uint32_t colour, const ClassTable& table) {
  const SemanticClass* found = nullptr;
  for (const SemanticClass& c : table.classes) {
    if (packed(c.colour) != colour) continue;
    if (found != nullptr)
      throw Error(
          fmt::format("colour {:06X} of the map is that of class {} and of {}; say which "
                      "is meant with --legend",
                      colour, found->name, c.name));
    found = &c;
  }
  return found == nullptr ? std::nullopt : std::optional(found->id);
}

template <class Map, class Key>
std::optional<ClassId> look_up(const Map& entries, const Key& key) {
  const auto found = entries.find(key);
  return found == entries.end() ? std::nullopt : std::optional(found->second);
}

/// What the legend says of a label, if anything.
std::optional<ClassId> said_by(const Legend& legend, const MapFile& map, std::uint32_t label) {
  if (map.label_kind == LabelKind::colour) return look_up(legend.colours, label);
  if (map.label_kind == LabelKind::id) return look_up(legend.ids, label);
  return look_up(legend.names, map.names[label]);
}

/// The class of the truth's table whose colour, id or name a label is.
std::optional<ClassId> own_class_of(const MapFile& map, std::uint32_t label,
                                    const ClassTable& table) {
  if (map.label_kind == LabelKind::colour) return class_of_colour(label, table);
  if (map.label_kind == LabelKind::name) return class_of_name(map.names[label], table);
  return label < table.classes.size() ? std::optional(table.classes[label].id) : std::nullopt;
}

/// The legend's section for labels of this kind, and how many entries it has.
std::pair<const char*, std::size_t> section_of(LabelKind kind, const Legend& legend) {
  if (kind == LabelKind::colour) return {"colours", legend.colours.size()};
  if (kind == LabelKind::id) return {"ids", legend.ids.size()};
  return {"names", legend.names.size()};
}

void sort_by_count(std::vector<Leftover>& labels) {
  std::ranges::sort(labels, [](const Leftover& a, const Leftover& b) {
    return a.count != b.count ? a.count > b.count : a.label < b.label;
  });
}

/// The commonest of labels, with their counts.
std::string listed(const std::vector<Leftover>& labels) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t n = 0; n < std::min(kShown, labels.size()); ++n)
    text += fmt::format("{}{} ({} times)", n == 0 ? "" : ", ", excerpt(labels[n].label),
                        labels[n].count);
  if (labels.size() > kShown) text += fmt::format(" and {} more", labels.size() - kShown);
  return text.empty() ? "all are background" : text;
}

/// Of labels whose meaning nobody knows: more different colours than this, and more elements.
constexpr std::size_t kCameraColours = 1000;
constexpr double kMostOfACamera = 0.5, kMostMeaningless = 0.95;

/// Throws Error when the map's labels do not say classes: `meaningless` of `all` occupied elements
/// have a label without a meaning, and `some` one that means a class.
void check_meanings(const MapFile& map, const std::vector<Leftover>& leftovers, std::size_t all,
                    bool some, const std::optional<Legend>& legend) {
  std::size_t meaningless = 0;
  for (const Leftover& label : leftovers) meaningless += label.count;
  const double share =
      static_cast<double>(meaningless) / static_cast<double>(std::max(all, std::size_t{1}));
  const auto [section, entries] = section_of(map.label_kind, legend.value_or(Legend{}));
  const std::string mend = fmt::format(
      "give their meaning under `{}` of a file for --legend, or score the geometry alone with "
      "--geometry",
      section);
  if (map.label_kind == LabelKind::colour && leftovers.size() > kCameraColours &&
      share > kMostOfACamera)
    throw Error(fmt::format(
        "{} different colours without a meaning, on {:.1f} % of the map: these are a camera's "
        "colours rather than those of classes; {}",
        leftovers.size(), 100.0 * share, mend));
  if (!some && legend && entries == 0)
    throw Error(fmt::format("the map's labels are {}, and the legend has none: {}; {}", section,
                            listed(leftovers), mend));
  if (!some && leftovers.empty())
    throw EmptyMap("no label of the map means a class: all are background; " + mend);
  if (!some) throw Error("no label of the map means a class: " + listed(leftovers) + "; " + mend);
  if (share > kMostMeaningless)
    throw Error(fmt::format("the labels of {:.1f} % of the map mean no class: {}; {}",
                            100.0 * share, listed(leftovers), mend));
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

std::vector<Leftover> labels_of(const MapFile& map) {
  std::unordered_map<std::uint32_t, std::size_t> counts;
  for (std::size_t n = 0; n < map.labels.size(); ++n)
    if (map.is_occupied(n)) ++counts[map.labels[n]];
  std::vector<Leftover> labels;
  labels.reserve(counts.size());
  for (const auto& [label, count] : counts) labels.push_back({spelt(map, label), count});
  sort_by_count(labels);
  return labels;
}

Labelling apply_legend(const MapFile& map, const std::optional<Legend>& legend,
                       const ClassTable& table) {
  Labelling labelling;
  labelling.classes.assign(map.size(), kBackground);
  if (map.label_kind == LabelKind::none) return labelling;

  struct Known {
    std::optional<ClassId> meaning;
    bool by_legend = false;
    std::size_t count = 0;
  };
  std::unordered_map<std::uint32_t, Known> known;
  bool some = false;
  std::size_t occupied = 0;
  for (std::size_t n = 0; n < map.size(); ++n) {
    const auto [entry, is_new] = known.try_emplace(map.labels[n]);
    Known& label = entry->second;
    if (is_new) {
      if (legend) label.meaning = said_by(*legend, map, map.labels[n]);
      label.by_legend = label.meaning.has_value();
      if (!label.meaning) label.meaning = own_class_of(map, map.labels[n], table);
    }
    labelling.classes[n] = label.meaning.value_or(kBackground);
    if (!map.is_occupied(n)) continue;
    ++label.count;
    ++occupied;
    some = some || labelling.classes[n] != kBackground;
  }
  for (const auto& [label, of_label] : known) {
    if (of_label.count == 0 || of_label.by_legend) continue;
    if (!of_label.meaning)
      labelling.leftovers.push_back({spelt(map, label), of_label.count});
    else if (legend && map.label_kind != LabelKind::name && *of_label.meaning != kBackground)
      labelling.unlisted.push_back({spelt(map, label), of_label.count});
  }
  sort_by_count(labelling.leftovers);
  sort_by_count(labelling.unlisted);
  check_meanings(map, labelling.leftovers, occupied, some, legend);
  return labelling;
}

}  // namespace mapscore::eval
