// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/legend.hpp"

#include "core/error.hpp"
#include "eval/map_files/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace mapscore::eval {
namespace {

std::uint32_t packed(const Colour& colour) {
  return static_cast<std::uint32_t>(colour.r) << 16 | static_cast<std::uint32_t>(colour.g) << 8 |
         colour.b;
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

std::optional<ClassId> class_of_name(const std::string& name, const ClassTable& table) {
  const auto found = std::ranges::find(table.classes, name, &SemanticClass::name);
  return found == table.classes.end() ? std::nullopt : std::optional(found->id);
}

template <class Map, class Key>
std::optional<ClassId> look_up(const Map& entries, const Key& key) {
  const auto found = entries.find(key);
  return found == entries.end() ? std::nullopt : std::optional(found->second);
}

std::optional<ClassId> meaning_of(const MapFile& map, std::uint32_t label,
                                  const std::optional<Legend>& legend, const ClassTable& table) {
  switch (map.label_kind) {
    case LabelKind::colour:
      return legend ? look_up(legend->colours, label) : class_of_colour(label, table);
    case LabelKind::id:
      if (legend) return look_up(legend->ids, label);
      return label < table.classes.size() ? std::optional(table.classes[label].id) : std::nullopt;
    case LabelKind::name: {
      const std::string& name = map.names[label];
      const auto meant = legend ? look_up(legend->names, name) : std::nullopt;
      return meant ? meant : class_of_name(name, table);
    }
    case LabelKind::none:
      break;
  }
  return std::nullopt;
}

const char* section_of(LabelKind kind) {
  switch (kind) {
    case LabelKind::colour:
      return "colours";
    case LabelKind::id:
      return "ids";
    default:
      return "names";
  }
}

std::size_t entries_of(const Legend& legend, LabelKind kind) {
  switch (kind) {
    case LabelKind::colour:
      return legend.colours.size();
    case LabelKind::id:
      return legend.ids.size();
    default:
      return legend.names.size();
  }
}

bool occupied(const MapFile& map, std::size_t n) {
  return map.occupied.empty() || map.occupied[n] != 0;
}

void sort_by_count(std::vector<Leftover>& labels) {
  std::ranges::sort(labels, [](const Leftover& a, const Leftover& b) {
    return a.count != b.count ? a.count > b.count : a.label < b.label;
  });
}

[[noreturn]] void refuse_meaningless(const MapFile& map, const std::vector<Leftover>& labels,
                                     const std::optional<Legend>& legend) {
  constexpr std::size_t kShown = 5;
  std::string listed;
  for (std::size_t n = 0; n < std::min(kShown, labels.size()); ++n)
    listed +=
        fmt::format("{}{} ({} times)", n == 0 ? "" : ", ", shown(labels[n].label), labels[n].count);
  if (labels.size() > kShown) listed += fmt::format(" and {} more", labels.size() - kShown);
  if (listed.empty()) listed = "all are background";
  const char* section = section_of(map.label_kind);
  const std::string what =
      legend && entries_of(*legend, map.label_kind) == 0
          ? fmt::format("the map's labels are {}, and the legend has none", section)
          : "no label of the map means a class";
  throw Error(
      fmt::format("{}: {}; give their meaning under `{}` of a file for --legend, or score "
                  "the geometry alone with --geometry",
                  what, listed, section));
}

}  // namespace

std::vector<Leftover> labels_of(const MapFile& map) {
  std::unordered_map<std::uint32_t, std::size_t> counts;
  for (std::size_t n = 0; n < map.labels.size(); ++n)
    if (occupied(map, n)) ++counts[map.labels[n]];
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
    std::size_t count = 0;
  };
  std::unordered_map<std::uint32_t, Known> known;
  bool some = false;
  for (std::size_t n = 0; n < map.size(); ++n) {
    const auto [entry, is_new] = known.try_emplace(map.labels[n]);
    if (is_new) entry->second.meaning = meaning_of(map, map.labels[n], legend, table);
    if (occupied(map, n)) ++entry->second.count;
    labelling.classes[n] = entry->second.meaning.value_or(kBackground);
    some = some || (occupied(map, n) && labelling.classes[n] != kBackground);
  }
  for (const auto& [label, of_label] : known)
    if (!of_label.meaning && of_label.count > 0)
      labelling.leftovers.push_back({spelt(map, label), of_label.count});
  sort_by_count(labelling.leftovers);
  if (!some) refuse_meaningless(map, labelling.leftovers, legend);
  return labelling;
}

}  // namespace mapscore::eval
