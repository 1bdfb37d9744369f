// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/grid_file.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/file_bytes.hpp"
#include "files/pgm.hpp"
#include "files/text.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace mapscore::eval {
namespace {

/// How a grey level becomes an occupancy.
struct GreyRule {
  bool negate = false, scale = false;
  double occupied_thresh = 0.65, free_thresh = 0.196;
};

/// What each grey level means, as ROS map_server reads it.
std::array<Occupancy, 256> meanings(const GreyRule& rule) {
  std::array<Occupancy, 256> values{};
  for (std::size_t level = 0; level < values.size(); ++level) {
    const auto grey = static_cast<double>(level);
    const double p = (rule.negate ? grey : 255.0 - grey) / 255.0;
    const double ratio = (p - rule.free_thresh) / (rule.occupied_thresh - rule.free_thresh);
    values[level] = p > rule.occupied_thresh ? kOccupiedCell
                    : p < rule.free_thresh   ? kFreeCell
                    : rule.scale             ? static_cast<Occupancy>(1.0 + 98.0 * ratio)
                                             : kUnknownCell;
  }
  return values;
}

double share_at(const YamlValue& root, const std::string& key) {
  const YamlValue value = root.at(key);
  const double share = value.number();
  if (!(share >= 0 && share <= 1)) value.fail("is a probability; give 0 to 1");
  return share;
}

GreyRule rule_of(const YamlValue& root) {
  GreyRule rule;
  rule.negate = root.at("negate").whole(0, 1) == 1;
  rule.occupied_thresh = share_at(root, "occupied_thresh");
  rule.free_thresh = share_at(root, "free_thresh");
  if (rule.free_thresh >= rule.occupied_thresh)
    root.at("free_thresh").fail("must lie below occupied_thresh");
  if (!root.has("mode")) return rule;
  const YamlValue mode = root.at("mode");
  rule.scale = mode.text() == "scale";
  if (!rule.scale && mode.text() != "trinary")
    mode.fail("must be trinary or scale; write one of them");
  return rule;
}

GridFrame frame_of(const YamlValue& root) {
  GridFrame frame;
  frame.resolution_m = root.at("resolution").positive();
  const YamlValue origin = root.at("origin");
  const std::vector<YamlValue> items = origin.elements();
  if (items.size() != 3)
    origin.fail("expected [x, y, yaw] in metres and radians; write three numbers");
  frame.T_map_grid = {items[0].number(), items[1].number(), items[2].number()};
  return frame;
}

std::filesystem::path image_file(const YamlValue& root, const std::filesystem::path& yaml_file) {
  const YamlValue value = root.at("image");
  const std::string name = value.text();
  if (name.empty() || name != shown(name)) value.fail("must name a PGM file");
  return yaml_file.parent_path() / name;  // an absolute name stays as it is
}

/// A rule that can say every value of the grid.
GreyRule rule_for(const OccupancyGrid& grid) {
  bool has_unknown = false, has_between = false;
  for (const Occupancy value : grid.cells()) {
    if (value < kUnknownCell || value > kOccupiedCell)
      throw Error(fmt::format("grid: a cell is {}; give -1 or 0 to 100", value));
    has_unknown = has_unknown || value == kUnknownCell;
    has_between = has_between || (value > kFreeCell && value < kOccupiedCell);
  }
  if (has_unknown && has_between)
    throw Error("grid: a PGM says either unknown cells or percentages; make it -1, 0 and 100 only");
  GreyRule rule;
  rule.scale = has_between;
  if (has_between) {  // on grey levels, so that 1 and 99 have one of their own
    rule.occupied_thresh = 166.0 / 255.0;
    rule.free_thresh = 50.0 / 255.0;
  }
  return rule;
}

/// The grey level of each value from -1 to 100, in place value + 1.
std::array<std::uint8_t, 102> levels_of(const GreyRule& rule) {
  std::array<std::uint8_t, 102> levels{};
  const std::array<Occupancy, 256> values = meanings(rule);
  for (std::size_t level = 0; level < values.size(); ++level)
    levels[static_cast<std::size_t>(values[level] + 1)] = static_cast<std::uint8_t>(level);
  levels[kFreeCell + 1] = 254;
  levels[kOccupiedCell + 1] = 0;
  if (!rule.scale) levels[0] = 205;
  return levels;
}

}  // namespace

OccupancyGrid load_grid(const std::filesystem::path& yaml_file) {
  const YamlValue root = load_yaml(yaml_file);
  root.only({"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"});
  GridFrame frame = frame_of(root);
  const std::array<Occupancy, 256> values = meanings(rule_of(root));
  const std::filesystem::path file = image_file(root, yaml_file);
  const GreyImage image = decode_pgm(read_file(file), file);
  frame.width = image.width;
  frame.height = image.height;
  OccupancyGrid grid(frame);
  std::size_t pixel = 0;
  for (std::int32_t row = frame.height - 1; row >= 0; --row)
    for (std::int32_t column = 0; column < frame.width; ++column)
      grid.set({column, row}, values[image.pixels[pixel++]]);
  return grid;
}

void save_grid(const OccupancyGrid& grid, const std::filesystem::path& yaml_file) {
  const GreyRule rule = rule_for(grid);
  const std::array<std::uint8_t, 102> levels = levels_of(rule);
  const GridFrame& frame = grid.frame();
  GreyImage image{frame.width, frame.height, {}};
  image.pixels.reserve(grid.cells().size());
  for (std::int32_t row = frame.height - 1; row >= 0; --row)
    for (std::int32_t column = 0; column < frame.width; ++column)
      image.pixels.push_back(levels[static_cast<std::size_t>(grid.at({column, row}) + 1)]);
  std::filesystem::path image_path = yaml_file;
  image_path.replace_extension(".pgm");
  if (image_path == yaml_file)
    throw Error(yaml_file.string() + ": is the image's name; give the YAML file the ending .yaml");
  const PlanarPose& T = frame.T_map_grid;
  const std::string yaml = fmt::format(
      "image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: {}\n"
      "free_thresh: {}\nmode: {}\n",
      yaml_quoted(image_path.filename().string()), frame.resolution_m, T.x_m, T.y_m, T.yaw_rad,
      rule.occupied_thresh, rule.free_thresh, rule.scale ? "scale" : "trinary");
  write_whole_file(image_path, encode_pgm(image));
  write_whole_file(yaml_file, yaml);
}

}  // namespace mapscore::eval
