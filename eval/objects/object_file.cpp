// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/object_file.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMaxCount = 1'000'000'000;
/// A kilometre beyond which no home reaches: coordinates stay far from overflow.
constexpr double kMaxReach_m = 1e6;

std::string line_of(const MapObject& object, const ClassTable& table) {
  if (object.class_id == kBackground || object.class_id >= table.classes.size())
    throw Error(fmt::format("object {}: class {} is not in the table; remove the object", object.id,
                            object.class_id));
  const Eigen::Vector3d& size = object.box.size_m;
  std::string text = fmt::format(
      "  - {{id: {}, class: {}, T_map_object: [{}], size_m: [{}, {}, {}],\n"
      "     last_seen_s: {}, observations: {}, misses: {}, age: {}, confidence: {}",
      object.id, yaml_quoted(table.classes[object.class_id].name),
      join_numbers(numbers_of(object.box.T_frame_box), ", "), size.x(), size.y(), size.z(),
      object.last_seen_s, object.observations, object.misses, object.age, object.confidence);
  if (!object.model.empty()) text += fmt::format(", model: {}", yaml_quoted(object.model));
  return text + "}\n";
}

template <std::size_t kSize>
std::array<double, kSize> numbers_at(const YamlValue& parent, const std::string& key,
                                     const char* expected) {
  const YamlValue value = parent.at(key);
  const std::vector<YamlValue> items = value.elements();
  std::array<double, kSize> numbers{};
  if (items.size() != kSize) value.fail(std::string("expected ") + expected);
  for (std::size_t n = 0; n < kSize; ++n) {
    numbers[n] = items[n].number();
    if (std::abs(numbers[n]) > kMaxReach_m)
      items[n].fail(fmt::format("beyond {:g}; give metres", kMaxReach_m));
  }
  return numbers;
}

ClassId class_at(const YamlValue& item, const ClassTable& table) {
  const YamlValue value = item.at("class");
  std::vector<std::string> names;
  for (const SemanticClass& c : table.classes) {
    if (c.id == kBackground) continue;
    if (c.name == value.text()) return c.id;
    names.push_back(c.name);
  }
  value.fail(fmt::format("no class '{}'; there are: {}", value.text(), fmt::join(names, ", ")));
}

int count_at(const YamlValue& item, const std::string& key) {
  return static_cast<int>(item.at(key).whole(0, kMaxCount));
}

MapObject object_of(const YamlValue& item, const ClassTable& table) {
  item.only({"id", "class", "T_map_object", "size_m", "model", "last_seen_s", "observations",
             "misses", "age", "confidence"});
  MapObject object;
  object.id =
      static_cast<ObjectId>(item.at("id").whole(1, std::numeric_limits<ObjectId>::max() - 1));
  object.class_id = class_at(item, table);
  const auto pose = pose_of(numbers_at<7>(item, "T_map_object", "[tx, ty, tz, qx, qy, qz, qw]"));
  if (!pose) item.at("T_map_object").fail("quaternion is not of length 1; normalise it");
  object.box.T_frame_box = *pose;
  const auto size = numbers_at<3>(item, "size_m", "[x, y, z], the box's lengths");
  if (*std::min_element(size.begin(), size.end()) < 0.0)
    item.at("size_m").fail("a negative length; give the box's lengths along its axes");
  object.box.size_m = {size[0], size[1], size[2]};
  if (item.has("model")) object.model = item.at("model").text();
  object.last_seen_s = item.at("last_seen_s").number();
  object.observations = count_at(item, "observations");
  object.misses = count_at(item, "misses");
  object.age = count_at(item, "age");
  object.confidence = item.at("confidence").number();
  if (object.confidence < 0.0 || object.confidence > 1.0)
    item.at("confidence").fail("expected a number from 0 to 1");
  return object;
}

}  // namespace

Pose ObjectFile::T_world_map() const {
  return map_from_world(map_origin_m, map_yaw_deg * std::numbers::pi / 180.0).inverse();
}

std::string object_text(const ObjectFile& file, const ClassTable& table) {
  std::string text = fmt::format(
      "# Object map of mapscore (docs/objects.md). T_map_object: x, y, z in metres and quaternion\n"
      "# x, y, z, w of the box's centre and axes; size_m: its lengths along these.\n"
      "format_version: {}\nmap_origin_m: [{}, {}, {}]\nmap_yaw_deg: {}\nobjects:",
      kObjectFileFormat, file.map_origin_m.x(), file.map_origin_m.y(), file.map_origin_m.z(),
      file.map_yaw_deg);
  text += file.objects.empty() ? " []\n" : "\n";
  for (const MapObject& object : file.objects) text += line_of(object, table);
  return text;
}

void write_objects(const std::filesystem::path& path, const ObjectFile& file,
                   const ClassTable& table) {
  write_whole_file(path, object_text(file, table));
}

ObjectFile read_objects(const std::filesystem::path& path, const ClassTable& table) {
  const YamlValue root = load_yaml(path);
  const YamlValue version = root.at("format_version");
  if (version.text() != std::to_string(kObjectFileFormat))
    version.fail(
        fmt::format("an object map of another format; this program reads {}", kObjectFileFormat));
  root.only({"format_version", "map_origin_m", "map_yaw_deg", "objects"});
  ObjectFile file;
  const auto origin = numbers_at<3>(root, "map_origin_m", "[x, y, z]");
  file.map_origin_m = {origin[0], origin[1], origin[2]};
  file.map_yaw_deg = root.at("map_yaw_deg").number();
  if (std::abs(file.map_yaw_deg) > 360.0) root.at("map_yaw_deg").fail("expected -360 to 360");
  for (const YamlValue& item : root.at("objects").elements()) {
    file.objects.push_back(object_of(item, table));
    const std::size_t count = file.objects.size();
    if (count > 1 && file.objects[count - 2].id >= file.objects.back().id)
      item.at("id").fail("not above that of the object before; sort them, each id once");
  }
  return file;
}

}  // namespace mapscore::eval
