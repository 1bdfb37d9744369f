// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/labelled_folder.hpp"

#include "eval/foreign/association.hpp"
#include "eval/foreign/camera_file.hpp"
#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/suggestion.hpp"
#include "files/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace mapscore::eval {
namespace {

constexpr const char* kMendOutside = "copy it there, or give --follow if the folder is your own";

namespace fs = std::filesystem;

/// Focal lengths that lenses without distortion have, by the images' width: 174 to 1.1 degrees.
constexpr double kWidest = 40.0, kNarrowest = 50.0;

/// Velocities are taken over at least so long, so that jitter of poses counts little.
constexpr double kMotionWindow_s = 0.1;

/// `late_s` is added to each.
std::vector<double> stamps_of(const std::vector<StampedImage>& images, double late_s = 0.0) {
  std::vector<double> stamps;
  for (const StampedImage& image : images) stamps.push_back(image.stamp_s + late_s);
  return stamps;
}

/// Bytes of an image that has the camera's size.
std::string read_sized(const fs::path& file, const CameraModel& camera, const char* what) {
  std::string bytes = read_file(file);
  const cv::Size size = png_size(bytes, file.string());
  if (size != cv::Size(camera.width_px, camera.height_px))
    refuse(file,
           "is {} x {}, {} images are {} x {} by recording.yaml or the first of them; make all of "
           "that size",
           size.width, size.height, what, camera.width_px, camera.height_px);
  return bytes;
}

/// The same depths in 1/5000 m; what does not fit is none.
cv::Mat1w in_our_units(const cv::Mat1w& depth, double units_per_m) {
  if (units_per_m == kDepthUnitsPerMetre) return depth;
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  cv::Mat1w ours(depth.size());
  std::transform(depth.begin(), depth.end(), ours.begin(), [&](std::uint16_t value) {
    const double converted = std::round(value * kDepthUnitsPerMetre / units_per_m);
    return converted > kMost ? std::uint16_t{0} : static_cast<std::uint16_t>(converted);
  });
  return ours;
}

}  // namespace

LabelledFolder::LabelledFolder(const fs::path& folder, const LabelledFolderOptions& options)
    : folder_(folder), options_(options) {
  if (!fs::is_directory(folder))
    refuse(folder, "no such folder; {}", path_suggestion(folder, "give the folder of a recording"));
  read_meaning();
  pair_frames();
  size_cameras();
  if (!options_.cameras.empty()) check_cameras();
}

void LabelledFolder::read_meaning() {
  const fs::path own = folder_ / "recording.yaml";
  const bool is_ours = fs::is_regular_file(own);
  if (!is_ours && options_.cameras.empty())
    refuse(folder_, "no recording.yaml in it; give --intrinsics fx,fy,cx,cy or a file");
  if (!is_ours && options_.classes.empty())
    refuse(folder_, "no recording.yaml in it; give --classes FILE");
  if (is_ours) {
    const RecordingInfo info = read_info(own);
    calibration_ = info.calibration;
    classes_ = {info.table, true, {}};
  }
  if (!options_.cameras.empty()) {
    const BelievedCameras cameras =
        read_cameras(options_.cameras, is_ours ? std::optional(calibration_) : std::nullopt);
    calibration_ = cameras.calibration;
    time_offset_s_ = cameras.time_offset_s;
  }
  if (options_.range_m) {
    std::tie(calibration_.range_min_m, calibration_.range_max_m) = *options_.range_m;
    if (calibration_.range_max_m <= calibration_.range_min_m)
      throw Error("--range_m: the most is not above the least; give near, then far");
  }
  if (!options_.classes.empty()) classes_ = read_label_classes(options_.classes, options_.masks);
  if (classes_.has_instances && options_.masks == ClassMasks::classes)
    throw Error(
        "--masks classes: pixels are instance ids here, an object each; leave it out, or give "
        "--classes with the labels of classes");
}

std::vector<StampedImage> LabelledFolder::label_images() const {
  if (fs::is_regular_file(folder_ / "label.txt")) return read_stamp_list(folder_ / "label.txt");
  const bool has_color = fs::is_regular_file(folder_ / "color.txt");
  std::vector<StampedImage> images =
      read_stamp_list(folder_ / (has_color ? "color.txt" : "rgb.txt"));
  for (StampedImage& image : images) {
    if (!options_.follow) check_inside(folder_, image.path, kMendOutside);
    image.path = fs::path(sibling_path(image.path, "label")).replace_extension(".png").string();
  }
  return images;
}

std::optional<Pose> LabelledFolder::pose_near(const std::vector<TrajectoryPose>& trajectory,
                                              double stamp_s) const {
  const auto after = first_from(trajectory, stamp_s);
  const bool between = after != trajectory.begin() && after != trajectory.end();
  if (between && after->stamp_s - std::prev(after)->stamp_s <= options_.max_pose_gap_s)
    return interpolated(trajectory, stamp_s);
  const TrajectoryPose& nearest = trajectory[nearest_in_time(trajectory, stamp_s)];
  if (std::abs(nearest.stamp_s - stamp_s) >= options_.max_offset_s) return std::nullopt;
  return nearest.T_world_base;
}

void LabelledFolder::pair_frames() {
  const std::vector<StampedImage> labels = label_images();
  depth_ = read_stamp_list(folder_ / "depth.txt");
  const std::vector<Association> pairs =
      associate(stamps_of(labels, time_offset_s_), stamps_of(depth_), options_.max_offset_s);
  counts_.labels = static_cast<int>(labels.size());
  counts_.no_depth = static_cast<int>(labels.size() - pairs.size());
  for (const Association& pair : pairs)
    frames_.push_back({labels[pair.first].path, depth_[pair.second],
                       labels[pair.first].stamp_s + time_offset_s_ - depth_[pair.second].stamp_s,
                       Pose::Identity()});
  if (options_.poses) {
    const fs::path poses = folder_ / "groundtruth.txt";
    if (!fs::is_regular_file(poses))
      refuse(poses,
             "is missing; give --poses visual_odometry, or visual_slam, which finds them in "
             "the depth images");
    trajectory_ = read_trajectory(poses);
    place(trajectory_);
  } else if (frames_.empty()) {
    place({});
  }
  check_images();
}

void LabelledFolder::place(const std::vector<TrajectoryPose>& trajectory) {
  std::vector<LabelledDepth> placed;
  for (LabelledDepth& frame : frames_)
    if (const auto pose = pose_near(trajectory, frame.depth.stamp_s)) {
      frame.T_world_base = *pose;
      placed.push_back(std::move(frame));
    } else {
      ++counts_.no_pose;
    }
  frames_ = std::move(placed);
  if (frames_.empty())
    refuse(folder_,
           "no frame left: of {} label images {} have no depth image within {} s, {} no pose; mend "
           "the stamps or give --max_offset_s",
           counts_.labels, counts_.no_depth, options_.max_offset_s, counts_.no_pose);
}

std::optional<Vector6> LabelledFolder::motion(int index) const {
  const double stamp_s = at(index).depth.stamp_s;
  const auto after = first_from(trajectory_, stamp_s + kMotionWindow_s / 2);
  const auto before = first_from(trajectory_, stamp_s - kMotionWindow_s / 2);
  if (before == trajectory_.begin() || after == trajectory_.end()) return std::nullopt;
  const TrajectoryPose &from = *std::prev(before), &to = *after;
  const double seconds = to.stamp_s - from.stamp_s;
  if (seconds > 2 * options_.max_pose_gap_s + kMotionWindow_s) return std::nullopt;
  const Pose& T_base_depth = calibration_.T_base_depth;
  return log_pose((from.T_world_base * T_base_depth).inverse() * to.T_world_base * T_base_depth) /
         seconds;
}

void LabelledFolder::check_images() const {
  for (const LabelledDepth& frame : frames_)
    for (const std::string& path : {frame.label, frame.depth.path}) {
      if (!options_.follow) check_inside(folder_, path, kMendOutside);
      if (!fs::is_regular_file(folder_ / path))
        refuse(folder_ / path, "image is missing; copy it there, or list only what there is");
    }
}

void LabelledFolder::size_cameras() {
  const auto take_size = [&](const std::string& path, CameraModel& camera) {
    const fs::path file = folder_ / path;
    if (camera.width_px > 0) return;
    const cv::Size size = png_size(read_file(file), file.string());
    camera.width_px = size.width;
    camera.height_px = size.height;
  };
  if (!options_.cameras.empty()) {
    calibration_.color.width_px = calibration_.depth.width_px = 0;
    take_size(frames_.front().label, calibration_.color);
    take_size(frames_.front().depth.path, calibration_.depth);
  }
  const CameraModel &color = calibration_.color, &depth = calibration_.depth;
  const bool other_size = color.width_px != depth.width_px || color.height_px != depth.height_px;
  if (other_size && color.fx_px == depth.fx_px && color.cx_px == depth.cx_px)
    refuse(folder_ / frames_.front().depth.path,
           "depth is {} x {}, labels are {} x {}; give --intrinsics FILE with a depth camera, or "
           "make both of one size",
           depth.width_px, depth.height_px, color.width_px, color.height_px);
}

void LabelledFolder::check_cameras() const {
  const auto check_pinhole = [&](const char* name, const CameraModel& camera) {
    for (const double focal_px : {camera.fx_px, camera.fy_px})
      if (!(focal_px > camera.width_px / kWidest && focal_px < camera.width_px * kNarrowest))
        throw Error(fmt::format(
            "a focal length of {} px is none of {} images that are {} px wide; give pixels, from "
            "{} to {} times the width",
            focal_px, name, camera.width_px, 1 / kWidest, kNarrowest));
    const bool inside = camera.cx_px >= 0.0 && camera.cy_px >= 0.0 &&
                        camera.cx_px <= camera.width_px - 1.0 &&
                        camera.cy_px <= camera.height_px - 1.0;
    if (!inside)
      throw Error(fmt::format(
          "the principal point ({}, {}) lies outside the {} images, {} x {}; give the intrinsics "
          "of images of this size",
          camera.cx_px, camera.cy_px, name, camera.width_px, camera.height_px));
  };
  try {
    check_pinhole("label", calibration_.color);
    check_pinhole("depth", calibration_.depth);
    check(calibration_);
  } catch (const Error& error) {
    throw Error(fmt::format("cameras {}: {}", shown(options_.cameras), error.what()));
  }
}

std::vector<fs::path> LabelledFolder::image_files() const {
  std::vector<fs::path> files;
  for (const LabelledDepth& frame : frames_)
    files.insert(files.end(), {folder_ / frame.label, folder_ / frame.depth.path});
  return files;
}

Frame LabelledFolder::read(int index, ClassTable& table) const {
  const LabelledDepth& source = at(index);
  const CameraModel& color = calibration_.color;
  const fs::path label_file = folder_ / source.label;
  Frame frame;
  frame.index = frame.depth_index = index;
  frame.stamp_s = source.depth.stamp_s;
  frame.T_world_base = source.T_world_base;
  const cv::Mat1w label = decode_id_png(read_sized(label_file, color, "label"),
                                        {color.width_px, color.height_px}, label_file.string());
  LabelledImage labelled = instances_of(label, classes_, options_.masks);
  frame.label = labelled.instances;
  table = std::move(labelled.table);
  frame.depth = read_depth(source.depth);
  return frame;
}

cv::Mat1w LabelledFolder::read_depth(const StampedImage& image) const {
  const CameraModel& camera = calibration_.depth;
  if (!options_.follow) check_inside(folder_, image.path, kMendOutside);
  const fs::path file = folder_ / image.path;
  return in_our_units(decode_grey16_png(read_sized(file, camera, "depth"),
                                        {camera.width_px, camera.height_px}, file.string()),
                      options_.depth_units_per_m);
}

}  // namespace mapscore::eval
