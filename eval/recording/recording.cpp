// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"

#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/shape_files.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/suggestion.hpp"

#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// What a recording may hold of the robot's other sensors.
std::vector<std::string> log_paths(const RecordingInfo& info) {
  std::vector<std::string> paths;
  if (info.odometry_count > 0) paths.emplace_back(kOdometryFile);
  if (info.scan_count > 0) paths.emplace_back(kScanFile);
  return paths;
}

void check_is_recording(const fs::path& folder) {
  if (!fs::is_directory(folder))
    refuse(folder, "no such folder; {}", path_suggestion(folder, "give the folder of a recording"));
  if (!fs::is_regular_file(folder / "recording.yaml"))
    refuse(folder, "not a recording (no recording.yaml in it); make one with 'mapscore record'");
}

void check_count(const fs::path& list, std::size_t lines, const char* key, int count) {
  if (lines != static_cast<std::size_t>(count))
    refuse(list, "{} lines, recording.yaml says {} {}; record again", lines, key, count);
}

/// The pose of a depth image; the trajectory has a line at its stamp.
const Pose& pose_at(const fs::path& file, const std::vector<TrajectoryPose>& trajectory,
                    const StampedImage& image) {
  const auto line = first_from(trajectory, image.stamp_s);
  if (line == trajectory.end() || line->stamp_s != image.stamp_s)
    refuse(file, "no pose at stamp {} of {}; give one line for each line of depth.txt",
           image.stamp_s, image.path);
  return line->T_world_base;
}

void check_files(const fs::path& folder, const std::vector<std::string>& images, bool has_truth) {
  std::error_code no_such_name;  // such as one that is too long
  for (const std::string& image : images) {
    check_inside(folder, image, "a recording holds its own images: copy it there");
    if (!fs::is_regular_file(folder / image, no_such_name))
      refuse(folder / image, "image is missing; copy the recording anew or record again");
  }
  if (has_truth && !fs::is_regular_file(folder / "truth/shapes.csv"))
    refuse(folder / "truth/shapes.csv",
           "file is missing; record again, or set has_truth: false to map without scores");
}

void check_logs(const fs::path& folder, const std::vector<std::string>& logs) {
  for (const std::string& log : logs)
    if (!fs::is_regular_file(folder / log))
      refuse(folder / log,
             "file is missing, which recording.yaml announces; copy the recording anew or record "
             "again");
}

void check_has(const fs::path& folder, bool has, const char* what) {
  if (!has)
    refuse(folder, "the recording has no {}; record a drive with trajectory.drive: wheels", what);
}

cv::Size size_of(const CameraModel& camera) {
  return {camera.width_px, camera.height_px};
}

}  // namespace

Recording Recording::open(const fs::path& folder) {
  check_is_recording(folder);
  Recording recording;
  recording.folder_ = folder;
  recording.info_ = read_info(folder / "recording.yaml");
  const bool has_truth = recording.info_.has_truth;
  recording.color_ = read_stamp_list(folder / "color.txt");
  const auto depth = read_stamp_list(folder / "depth.txt");
  recording.trajectory_ = read_trajectory(folder / "groundtruth.txt");
  check_count(folder / "color.txt", recording.color_.size(), "frame_count",
              recording.info_.frame_count);
  for (const StampedImage& image : depth)
    recording.depth_.push_back(
        {image, pose_at(folder / "groundtruth.txt", recording.trajectory_, image)});
  const std::vector<std::string> images = image_paths(recording.color_, depth, has_truth);
  check_files(folder, images, has_truth);
  const std::vector<std::string> logs = log_paths(recording.info_);
  check_logs(folder, logs);
  const std::vector<HashedFile> hashes = image_hashes(folder, images);
  recording.content_hash_ = eval::content_hash(folder, hashes, logs);
  for (const HashedFile& file : hashes) recording.image_hashes_.emplace(file.path, file.hash);
  return recording;
}

int Recording::depth_of(int index, double offset_s) const {
  check_frame(index);
  const double stamp_s = color_[static_cast<std::size_t>(index)].stamp_s + offset_s;
  return static_cast<int>(nearest_in_time(depth_, stamp_s));
}

Pose Recording::T_world_base_of_color(int index) const {
  check_frame(index);
  const StampedImage& image = color_[static_cast<std::size_t>(index)];
  if (const auto pose = interpolated(trajectory_, image.stamp_s)) return *pose;
  refuse(folder_ / "groundtruth.txt", "does not reach stamp {} of {}; lengthen the trajectory",
         image.stamp_s, image.path);
}

void Recording::check_frame(int index) const {
  if (index < 0 || index >= frame_count())
    refuse(folder_, "no frame {}; the recording has frames 0 to {}", index, frame_count() - 1);
}

std::string Recording::read_image(const std::string& path) const {
  std::string bytes = read_file(folder_ / path);
  if (hash_of(bytes) != image_hashes_.at(path))
    refuse(folder_ / path,
           "is not the image of this recording (its hash differs); copy the recording anew, or "
           "remove hashes.txt to take the images as they are");
  return bytes;
}

cv::Mat1w Recording::read_grey16(const std::string& path, const CameraModel& camera) const {
  return decode_grey16_png(read_image(path), size_of(camera), (folder_ / path).string());
}

std::string Recording::label_path(int index) const {
  return sibling_path(color_path(index), "label");
}

Frame Recording::read(int index, int depth_index, Channels channels) const {
  Frame frame;
  read_color(index, channels, frame);
  read_depth(depth_index, channels, frame);
  return frame;
}

void Recording::read_color(int index, Channels channels, Frame& frame) const {
  check_frame(index);
  frame.index = index;
  const std::string& path = color_[static_cast<std::size_t>(index)].path;
  const CameraModel& camera = info_.calibration.color;
  if (channels.color)
    frame.color = decode_color_png(read_image(path), size_of(camera), (folder_ / path).string());
  if (channels.label) frame.label = read_grey16(sibling_path(path, "label"), camera);
}

void Recording::read_depth(int depth_index, Channels channels, Frame& frame) const {
  if (depth_index < 0 || depth_index >= depth_count())
    refuse(folder_, "no depth image {}; the recording has 0 to {}", depth_index, depth_count() - 1);
  if (channels.depth_label && !info_.has_truth)
    refuse(folder_, "made without truth; it can be mapped, not scored");
  const DepthImage& image = depth_[static_cast<std::size_t>(depth_index)];
  const CameraModel& camera = info_.calibration.depth;
  frame.depth_index = depth_index;
  frame.stamp_s = image.stamp_s;
  frame.T_world_base = image.T_world_base;
  if (channels.depth) frame.depth = read_grey16(image.path, camera);
  if (channels.depth_label)
    frame.depth_label = read_grey16(sibling_path(image.path, "depth_label"), camera);
}

std::vector<OdometryPose> Recording::read_odometry() const {
  check_has(folder_, has_odometry(), "odometry");
  std::vector<OdometryPose> poses = eval::read_odometry(folder_ / kOdometryFile);
  check_count(folder_ / kOdometryFile, poses.size(), "odometry_count", info_.odometry_count);
  return poses;
}

ScanLog Recording::read_scans() const {
  check_has(folder_, has_scans(), "scans");
  ScanLog log = read_scan_log(folder_ / kScanFile);
  check_count(folder_ / kScanFile, log.scans.size(), "scan_count", info_.scan_count);
  return log;
}

std::vector<Shape> Recording::read_shapes() const {
  if (!info_.has_truth) refuse(folder_, "made without truth; it can be mapped, not scored");
  const std::size_t instances = info_.table.instances.size();
  std::vector<Shape> shapes = read_shape_table(folder_ / "truth/shapes.csv", instances);
  const fs::path meshes = folder_ / "truth/triangles.ply";
  if (!fs::exists(meshes)) return shapes;
  for (Shape& mesh : read_triangle_ply(meshes, instances)) shapes.push_back(std::move(mesh));
  return shapes;
}

ShapePoses Recording::read_poses() const {
  if (info_.motion.empty() || !info_.has_truth) return {};
  std::vector<double> stamps_s;
  for (const DepthImage& image : depth_) stamps_s.push_back(image.stamp_s);
  return read_shape_poses(folder_ / "truth/poses.csv", read_shapes().size(), stamps_s);
}

}  // namespace mapscore::eval
