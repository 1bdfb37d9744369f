// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/info_yaml.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/png.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace mapscore::eval {
namespace {

constexpr std::uint64_t kMaxFrames = 1'000'000;  // file names have six digits
constexpr std::uint64_t kMaxLogLines = 100'000'000;

std::string camera_text(const CameraModel& camera, double rate_hz) {
  return fmt::format(
      "width_px: {}, height_px: {}, fx_px: {}, fy_px: {}, cx_px: {}, cy_px: {}, rate_hz: {}",
      camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px,
      rate_hz);
}

CameraModel camera_of(const YamlValue& value) {
  CameraModel camera;
  camera.width_px = static_cast<int>(value.at("width_px").whole(1, kMostImageSide_px));
  camera.height_px = static_cast<int>(value.at("height_px").whole(1, kMostImageSide_px));
  if (const std::string problem = too_many_pixels(camera.width_px, camera.height_px);
      !problem.empty())
    value.fail(problem);
  camera.fx_px = value.at("fx_px").positive();
  camera.fy_px = value.at("fy_px").positive();
  camera.cx_px = value.at("cx_px").number();
  camera.cy_px = value.at("cy_px").number();
  return camera;
}

/// Ids stand in order without gaps, so the n-th entry has id n.
std::uint16_t id_of(const YamlValue& item, std::size_t expected) {
  if (expected > std::numeric_limits<std::uint16_t>::max()) item.fail("more than 65536 entries");
  return static_cast<std::uint16_t>(item.at("id").whole(expected, expected));
}

std::vector<Instance> instances_of(const YamlValue& value, std::size_t class_count) {
  std::vector<Instance> instances;
  for (const YamlValue& item : value.elements()) {
    item.only({"id", "name", "class"});
    const InstanceId id = id_of(item, instances.size());
    const auto class_id = static_cast<ClassId>(item.at("class").whole(0, class_count - 1));
    if (id == 0 && class_id != kBackground) item.fail("instance 0 is background, class 0");
    instances.push_back({id, item.at("name").name(), class_id});
  }
  if (instances.empty()) value.fail("no instances; list at least background with id 0");
  return instances;
}

BakedFaults baked_of(const YamlValue& value) {
  value.only({"seed", "depth", "labels"});
  BakedFaults baked;
  baked.seed = value.at("seed").whole(0, std::numeric_limits<std::uint64_t>::max());
  baked.depth = value.at("depth").text();
  baked.labels = value.at("labels").text();
  if (baked.depth.empty() && baked.labels.empty())
    value.fail("names no fault; say which, or remove the key");
  return baked;
}

void check_version(const YamlValue& root) {
  const YamlValue version = root.at("format_version");
  if (version.text() != std::to_string(kRecordingFormat))
    version.fail(fmt::format("recording of format {}, this program reads {}; record it again",
                             version.text(), kRecordingFormat));
}

/// 0 where the key is left out.
int count_of(const YamlValue& root, const std::string& key) {
  return root.has(key) ? static_cast<int>(root.at(key).whole(1, kMaxLogLines)) : 0;
}

}  // namespace

Calibration calibration_of(const YamlValue& root) {
  const YamlValue color = root.at("color"), depth = root.at("depth");
  color.only({"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px", "rate_hz"});
  depth.only({"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px", "rate_hz", "range_min_m",
              "range_max_m"});
  Calibration calibration;
  calibration.color = camera_of(color);
  calibration.depth = camera_of(depth);
  calibration.T_color_depth = pose_of(root.at("T_color_depth"));
  calibration.T_base_depth = pose_of(root.at("T_base_depth"));
  calibration.range_min_m = depth.at("range_min_m").number();
  calibration.range_max_m = depth.at("range_max_m").number();
  if (calibration.range_min_m < 0.0 || calibration.range_max_m <= calibration.range_min_m)
    depth.fail("expected 0 <= range_min_m < range_max_m");
  return calibration;
}

std::vector<SemanticClass> classes_of(const YamlValue& value) {
  std::vector<SemanticClass> classes;
  for (const YamlValue& item : value.elements()) {
    item.only({"id", "name", "colour", "detect"});
    SemanticClass c{id_of(item, classes.size()), item.at("name").name(), item.at("colour").colour(),
                    item.at("detect").boolean()};
    for (const SemanticClass& other : classes)
      if (other.name == c.name) item.fail("two classes have this name; rename one");
    classes.push_back(std::move(c));
  }
  if (classes.empty()) value.fail("no classes; list at least background with id 0");
  return classes;
}

std::string cameras_text(const Calibration& calibration, double color_rate_hz,
                         double depth_rate_hz) {
  return fmt::format("color: {{{}}}\ndepth: {{{}, range_min_m: {}, range_max_m: {}}}\n",
                     camera_text(calibration.color, color_rate_hz),
                     camera_text(calibration.depth, depth_rate_hz), calibration.range_min_m,
                     calibration.range_max_m);
}

std::string classes_text(const std::vector<SemanticClass>& classes) {
  std::string text = "classes:\n";
  for (const SemanticClass& c : classes)
    text += fmt::format("  - {{id: {}, name: {}, colour: \"{:02X}{:02X}{:02X}\", detect: {}}}\n",
                        c.id, yaml_quoted(c.name), c.colour.r, c.colour.g, c.colour.b, c.detect);
  return text;
}

std::string info_text(const RecordingInfo& info) {
  const Calibration& calibration = info.calibration;
  std::string text = fmt::format("format_version: {}\n", kRecordingFormat);
  text += fmt::format("scene: {}\nscene_hash: {}\nmujoco_version: {}\nseed: {}\n",
                      yaml_quoted(info.scene), yaml_quoted(info.scene_hash),
                      yaml_quoted(info.mujoco_version), info.seed);
  if (!info.motion.empty())
    text += fmt::format("motion: {}\nmotion_hash: {}\n", yaml_quoted(info.motion),
                        yaml_quoted(info.motion_hash));
  if (info.baked)
    text += fmt::format("baked: {{seed: {}, depth: {}, labels: {}}}\n", info.baked->seed,
                        yaml_quoted(info.baked->depth), yaml_quoted(info.baked->labels));
  text += fmt::format("frame_count: {}\nhas_truth: {}\n", info.frame_count, info.has_truth);
  if (info.odometry_count > 0) text += fmt::format("odometry_count: {}\n", info.odometry_count);
  if (info.scan_count > 0) text += fmt::format("scan_count: {}\n", info.scan_count);
  text += cameras_text(calibration, info.color_rate_hz, info.depth_rate_hz);
  text += fmt::format("T_color_depth: [{}]\nT_base_depth: [{}]\n",
                      join_numbers(numbers_of(calibration.T_color_depth), ", "),
                      join_numbers(numbers_of(calibration.T_base_depth), ", "));
  text += classes_text(info.table.classes);
  text += "instances:\n";
  for (const Instance& instance : info.table.instances)
    text += fmt::format("  - {{id: {}, name: {}, class: {}}}\n", instance.id,
                        yaml_quoted(instance.name), instance.class_id);
  return text;
}

RecordingInfo read_info(const std::filesystem::path& file) {
  const YamlValue root = load_yaml(file);
  check_version(root);
  root.only({"format_version", "scene", "scene_hash", "mujoco_version", "seed", "motion",
             "motion_hash", "baked", "frame_count", "has_truth", "odometry_count", "scan_count",
             "color", "depth", "T_color_depth", "T_base_depth", "classes", "instances"});
  RecordingInfo info;
  info.scene = root.at("scene").text();
  info.scene_hash = root.at("scene_hash").text();
  info.mujoco_version = root.at("mujoco_version").text();
  info.seed = root.at("seed").whole(0, std::numeric_limits<std::uint64_t>::max());
  if (root.has("motion") || root.has("motion_hash")) {
    info.motion = root.at("motion").text();
    info.motion_hash = root.at("motion_hash").text();
    if (info.motion.empty()) root.at("motion").fail("is empty; name the motion's file");
  }
  if (root.has("baked")) info.baked = baked_of(root.at("baked"));
  info.frame_count = static_cast<int>(root.at("frame_count").whole(1, kMaxFrames));
  info.has_truth = root.at("has_truth").boolean();
  info.odometry_count = count_of(root, "odometry_count");
  info.scan_count = count_of(root, "scan_count");
  info.calibration = calibration_of(root);
  info.color_rate_hz = root.at("color").at("rate_hz").positive();
  info.depth_rate_hz = root.at("depth").at("rate_hz").positive();
  info.table.classes = classes_of(root.at("classes"));
  info.table.instances = instances_of(root.at("instances"), info.table.classes.size());
  return info;
}

}  // namespace mapscore::eval
