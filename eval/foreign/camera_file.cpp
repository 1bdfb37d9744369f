// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/camera_file.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/text_rows.hpp"
#include "files/yaml_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr std::size_t kIntrinsics = 4;

/// The numbers between commas; nothing where one is none.
std::optional<std::vector<double>> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto number = parse_number(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

CameraModel camera_of(const std::vector<double>& numbers, const std::string& text) {
  if (numbers.size() != kIntrinsics || numbers[0] <= 0.0 || numbers[1] <= 0.0)
    throw Error(
        fmt::format("--intrinsics: '{}' is not fx,fy,cx,cy in pixels, fx and fy above 0; "
                    "undistort images of a camera with more",
                    text));
  return {0, 0, numbers[0], numbers[1], numbers[2], numbers[3]};
}

CameraModel camera_of(const YamlValue& value) {
  return {0,
          0,
          value.at("fx_px").positive(),
          value.at("fy_px").positive(),
          value.at("cx_px").number(),
          value.at("cy_px").number()};
}

Calibration read_camera_file(const std::filesystem::path& file) {
  const YamlValue root = load_yaml(file);
  root.only({"color", "depth", "T_color_depth", "T_base_depth", "range_min_m", "range_max_m"});
  Calibration cameras;
  root.at("color").only({"fx_px", "fy_px", "cx_px", "cy_px"});
  cameras.color = cameras.depth = camera_of(root.at("color"));
  if (root.has("depth")) {
    root.at("depth").only({"fx_px", "fy_px", "cx_px", "cy_px"});
    cameras.depth = camera_of(root.at("depth"));
  }
  cameras.T_color_depth =
      root.has("T_color_depth") ? pose_of(root.at("T_color_depth")) : Pose::Identity();
  cameras.T_base_depth =
      root.has("T_base_depth") ? pose_of(root.at("T_base_depth")) : Pose::Identity();
  cameras.range_min_m =
      root.has("range_min_m") ? root.at("range_min_m").number() : kForeignRangeMin_m;
  cameras.range_max_m =
      root.has("range_max_m") ? root.at("range_max_m").number() : kForeignRangeMax_m;
  if (cameras.range_min_m < 0.0 || cameras.range_max_m <= cameras.range_min_m)
    root.fail("expected 0 <= range_min_m < range_max_m");
  return cameras;
}

}  // namespace

Calibration read_cameras(const std::string& text) {
  const auto numbers = numbers_in(text);
  if (!numbers) return read_camera_file(text);
  Calibration cameras;
  cameras.color = cameras.depth = camera_of(*numbers, text);
  cameras.range_min_m = kForeignRangeMin_m;
  cameras.range_max_m = kForeignRangeMax_m;
  return cameras;
}

}  // namespace mapscore::eval
