// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/objects/object_file.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <numbers>

namespace mapscore::eval {
namespace {

/// Version of the layout of objects.yaml; a reader refuses any other.
constexpr int kObjectFileFormat = 1;
constexpr std::uint64_t kMaxCount = 1'000'000'000;
/// A kilometre beyond which no home reaches: coordinates stay far from overflow.
constexpr double kMaxReach_m = 1e6;

const SemanticClass& class_of(const MapObject& object, const ClassTable& table) {
  if (object.class_id == kBackground || object.class_id >= table.classes.size())
    throw Error(fmt::format("object {}: class {} is not in the table; remove the object", object.id,
                            object.class_id));
  return table.classes[object.class_id];
}

std::string line_of(const MapObject& object, const ClassTable& table) {
  const Eigen::Vector3d& size = object.box.size_m;
  std::string text = fmt::format(
      "  - {{id: {}, class: {}, T_map_object: [{}], size_m: [{}, {}, {}],\n"
      "     last_seen_s: {}, observations: {}, misses: {}, age: {}, confidence: {}",
      object.id, yaml_quoted(class_of(object, table).name),
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
  object.box.size_m = {size[0], size[1], size[2]};
  if (object.box.size_m.minCoeff() < 0.0)
    item.at("size_m").fail("a negative length; give the box's lengths along its axes");
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

bool names_mesh(const MapObject& object) {
  const std::string ending = std::filesystem::path(object.model).extension().string();
  if (ending == ".obj" || ending == ".stl" || ending == ".msh") return true;
  if (ending == ".xml") return false;
  throw Error(
      fmt::format("object {}: model '{}'; give a mesh (.obj, .stl, .msh) or an MJCF (.xml), "
                  "or none for its box",
                  object.id, shown(object.model)));
}

std::string asset_of(const MapObject& object) {
  if (object.model.empty()) return {};
  return fmt::format("    <{} name=\"model_{}\" file={}/>\n", names_mesh(object) ? "mesh" : "model",
                     object.id, xml_quoted(object.model));
}

std::string geom_of(const MapObject& object, const Colour& colour) {
  constexpr double kLeastSize_m = 1e-3;
  const bool boxed = object.model.empty();
  if (!boxed && !names_mesh(object))
    return fmt::format("<attach model=\"model_{0}\" prefix=\"object_{0}/\"/>", object.id);
  const std::string rgba =
      fmt::format("{:.4g} {:.4g} {:.4g} 1", colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  if (!boxed)
    return fmt::format("<geom type=\"mesh\" mesh=\"model_{}\" rgba=\"{}\"/>", object.id, rgba);
  const Eigen::Vector3d half = 0.5 * object.box.size_m.cwiseMax(kLeastSize_m);
  return fmt::format("<geom type=\"box\" size=\"{} {} {}\" rgba=\"{}\"/>", half.x(), half.y(),
                     half.z(), rgba);
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

std::string object_mjcf(const ObjectFile& file, const ClassTable& table) {
  const Pose T_world_map = file.T_world_map();
  std::string assets, bodies;
  for (const MapObject& object : file.objects) {
    const SemanticClass& c = class_of(object, table);
    const PoseNumbers pose = numbers_of(T_world_map * object.box.T_frame_box);
    assets += asset_of(object);
    bodies += fmt::format(
        "    <body name={} pos=\"{} {} {}\" quat=\"{} {} {} {}\">\n      {}\n    </body>\n",
        xml_quoted(fmt::format("{}_{}", c.name, object.id)), pose[0], pose[1], pose[2], pose[6],
        pose[3], pose[4], pose[5], geom_of(object, c.colour));
  }
  if (!assets.empty()) assets = "  <asset>\n" + assets + "  </asset>\n";
  return "<mujoco model=\"objects\">\n" + assets + "  <worldbody>\n" + bodies +
         "  </worldbody>\n</mujoco>\n";
}

std::string object_ply(const std::vector<MapObject>& objects, const ClassTable& table) {
  // Two triangles a face, counter-clockwise from outside; bit n of a corner: its side on axis n.
  static constexpr int kTriangles[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                            {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                            {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uint object\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      8 * objects.size(), 12 * objects.size());
  for (const MapObject& object : objects) {
    const Colour colour = class_of(object, table).colour;
    for (const Eigen::Vector3d& p : object.box.corners())
      text += fmt::format("{:.6g} {:.6g} {:.6g} {} {} {} {}\n", p.x(), p.y(), p.z(), colour.r,
                          colour.g, colour.b, object.id);
  }
  for (std::size_t n = 0; n < objects.size(); ++n)
    for (const auto& triangle : kTriangles)
      text += fmt::format("3 {} {} {}\n", 8 * n + static_cast<std::size_t>(triangle[0]),
                          8 * n + static_cast<std::size_t>(triangle[1]),
                          8 * n + static_cast<std::size_t>(triangle[2]));
  return text;
}

}  // namespace mapscore::eval
