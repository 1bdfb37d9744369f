// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/camera_file.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <vector>

namespace mapscore::eval {
namespace {

/// Least and most depth that counts where nothing says otherwise, metres.
constexpr double kRangeMin_m = 0.1, kRangeMax_m = 10.0;
constexpr double kMostOffset_s = 10.0;

CameraModel pinhole_of(const std::vector<double>& numbers, const std::string& text) {
  if (numbers.size() != 4 || numbers[0] <= 0.0 || numbers[1] <= 0.0)
    throw Error(
        fmt::format("cameras: '{}' is not fx,fy,cx,cy in pixels, fx and fy above 0; undistort "
                    "images of a camera with more",
                    text));
  return {0, 0, numbers[0], numbers[1], numbers[2], numbers[3]};
}

CameraModel pinhole_of(const YamlValue& value) {
  value.only({"fx_px", "fy_px", "cx_px", "cy_px"});
  const double fx_px = value.at("fx_px").positive(), fy_px = value.at("fy_px").positive();
  return {0, 0, fx_px, fy_px, value.at("cx_px").number(), value.at("cy_px").number()};
}

std::string pinhole_text(const CameraModel& camera) {
  return fmt::format("{{fx_px: {}, fy_px: {}, cx_px: {}, cy_px: {}}}", camera.fx_px, camera.fy_px,
                     camera.cx_px, camera.cy_px);
}

/// Of a folder that says nothing of its cameras: depth is registered to colour, and poses are
/// those of that camera.
Calibration registered(const CameraModel& color) {
  Calibration calibration{color, color, Pose::Identity(), Pose::Identity()};
  calibration.range_min_m = kRangeMin_m;
  calibration.range_max_m = kRangeMax_m;
  return calibration;
}

BelievedCameras read_camera_file(const std::filesystem::path& file,
                                 const std::optional<Calibration>& otherwise) {
  const YamlValue root = load_yaml(file);
  root.only({"color", "depth", "T_color_depth", "T_base_depth", "range_min_m", "range_max_m",
             "time_offset_s", "estimate"});
  BelievedCameras cameras;
  Calibration& calibration = cameras.calibration;
  if (otherwise) calibration = *otherwise;
  if (!otherwise || root.has("color")) calibration.color = pinhole_of(root.at("color"));
  if (!otherwise) calibration = registered(calibration.color);
  if (root.has("depth")) calibration.depth = pinhole_of(root.at("depth"));
  if (root.has("T_color_depth")) calibration.T_color_depth = pose_of(root.at("T_color_depth"));
  if (root.has("T_base_depth")) calibration.T_base_depth = pose_of(root.at("T_base_depth"));
  if (root.has("range_min_m")) calibration.range_min_m = root.at("range_min_m").number();
  if (root.has("range_max_m")) calibration.range_max_m = root.at("range_max_m").number();
  if (calibration.range_min_m < 0.0 || calibration.range_max_m <= calibration.range_min_m)
    root.at(root.has("range_max_m") ? "range_max_m" : "range_min_m")
        .fail("expected 0 <= range_min_m < range_max_m");
  if (root.has("time_offset_s")) cameras.time_offset_s = root.at("time_offset_s").number();
  if (!(std::abs(cameras.time_offset_s) <= kMostOffset_s))
    root.at("time_offset_s").fail("expected seconds from -10 to 10");
  return cameras;
}

}  // namespace

BelievedCameras read_cameras(const std::string& text, const std::optional<Calibration>& otherwise) {
  const auto numbers = parse_numbers(text, text.size());
  const bool is_list = text.find(',') != std::string::npos && !std::filesystem::exists(text);
  if (!numbers && !is_list) return read_camera_file(text, otherwise);
  const CameraModel color = pinhole_of(numbers.value_or(std::vector<double>{}), text);
  BelievedCameras cameras{otherwise.value_or(registered(color)), 0};
  cameras.calibration.color = color;
  return cameras;
}

std::string cameras_file_text(const BelievedCameras& cameras) {
  const Calibration& calibration = cameras.calibration;
  std::string text = fmt::format("color: {}\ndepth: {}\n", pinhole_text(calibration.color),
                                 pinhole_text(calibration.depth));
  text += fmt::format("T_color_depth: [{}]\nT_base_depth: [{}]\n",
                      join_numbers(numbers_of(calibration.T_color_depth), ", "),
                      join_numbers(numbers_of(calibration.T_base_depth), ", "));
  text += fmt::format("range_min_m: {}\nrange_max_m: {}\n", calibration.range_min_m,
                      calibration.range_max_m);
  if (cameras.time_offset_s != 0.0)
    text += fmt::format("time_offset_s: {}\n", cameras.time_offset_s);
  return text;
}

}  // namespace mapscore::eval
