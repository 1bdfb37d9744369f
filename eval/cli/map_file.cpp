// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/map_file.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

namespace mapscore::eval {
namespace {

template <class Integer>
std::optional<Integer> parse_integer(const std::string& text) {
  Integer value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<ClassId> parse_class(const std::string& text, const ClassTable& table) {
  for (const SemanticClass& c : table.classes)
    if (c.name == text) return c.id;
  const auto id = parse_integer<ClassId>(text);
  return id && *id < table.classes.size() ? id : std::nullopt;
}

MapVoxel parse_row(const std::string& line, const std::string& where, const ClassTable& table) {
  std::istringstream cells(line);
  std::string i, j, k, name;
  std::getline(cells, i, ',');
  std::getline(cells, j, ',');
  std::getline(cells, k, ',');
  std::getline(cells, name, ',');
  const auto x = parse_integer<std::int32_t>(i), y = parse_integer<std::int32_t>(j),
             z = parse_integer<std::int32_t>(k);
  if (!x || !y || !z) throw Error(where + ": needs whole numbers i,j,k and a class");
  const auto class_id = parse_class(name, table);
  if (!class_id)
    throw Error(where + ": class '" + name +
                "' is not in the truth; `mapscore info` lists its classes");
  return {{*x, *y, *z}, *class_id, 1.0, true};
}

std::vector<MapVoxel> read_csv(const std::filesystem::path& file, const ClassTable& table) {
  std::ifstream stream(file);
  if (!stream) throw Error(file.string() + ": cannot be opened; check the path");
  std::vector<MapVoxel> voxels;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool header = number == 1 && line.rfind("i,j,k,class", 0) == 0;
    if (!header && !line.empty())
      voxels.push_back(parse_row(line, fmt::format("{}:{}", file.string(), number), table));
  }
  return voxels;
}

}  // namespace

std::vector<MapVoxel> read_map(const std::filesystem::path& file, double voxel_m,
                               const ClassTable& table) {
  if (file.extension() == ".csv") return read_csv(file, table);
  if (file.extension() != ".ot")
    throw Error(file.string() + ": maps are read from .ot and .csv (i,j,k,class); convert it");
  const SemanticMap map = SemanticMap::load(file);
  if (std::abs(map.edge_m() - voxel_m) > 1e-9)
    throw Error(fmt::format("{}: a map of {} m voxels; score it with --voxel_m {}", file.string(),
                            map.edge_m(), map.edge_m()));
  return map.voxels();
}

}  // namespace mapscore::eval
