// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording.hpp"

#include "core/error.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/png.hpp"
#include "eval/recording/shape_table.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/recording/triangle_ply.hpp"

#include <fmt/format.h>

#include <system_error>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void check_is_recording(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw Error(fmt::format("{}: no such folder; give the folder of a recording", folder.string()));
  if (!fs::is_regular_file(folder / "recording.yaml"))
    throw Error(
        fmt::format("{}: not a recording (no recording.yaml in it); make one with 'mapscore "
                    "record'",
                    folder.string()));
}

void check_count(const fs::path& list, std::size_t lines, int frame_count) {
  if (lines != static_cast<std::size_t>(frame_count))
    throw Error(fmt::format("{}: {} lines, recording.yaml says frame_count {}; record again",
                            list.string(), lines, frame_count));
}

/// Every depth image has its pose, in the same order.
void check_poses(const fs::path& file, const std::vector<TrajectoryPose>& poses,
                 const std::vector<StampedImage>& depth) {
  for (std::size_t i = 0; i < depth.size(); ++i)
    if (i >= poses.size() || poses[i].stamp_s != depth[i].stamp_s)
      throw Error(
          fmt::format("{}: no pose at stamp {} of {}; give one line for each line of depth.txt",
                      file.string(), depth[i].stamp_s, depth[i].path));
  if (poses.size() != depth.size())
    throw Error(fmt::format("{}: {} poses for {} lines of depth.txt; give one for each",
                            file.string(), poses.size(), depth.size()));
}

void check_files(const fs::path& folder, const std::vector<std::string>& images, bool has_truth) {
  std::error_code no_such_name;  // such as one that is too long
  for (const std::string& image : images)
    if (!fs::is_regular_file(folder / image, no_such_name))
      throw Error(fmt::format("{}: image is missing; copy the recording anew or record again",
                              (folder / image).string()));
  if (has_truth && !fs::is_regular_file(folder / "truth/shapes.csv"))
    throw Error(
        fmt::format("{}: file is missing; record again, or set has_truth: false to map "
                    "without scores",
                    (folder / "truth/shapes.csv").string()));
}

cv::Size size_of(const CameraModel& camera) {
  return {camera.width_px, camera.height_px};
}

cv::Mat1w read_grey16(const fs::path& file, const CameraModel& camera) {
  return decode_grey16_png(read_file(file), size_of(camera), file.string());
}

}  // namespace

Recording Recording::open(const fs::path& folder) {
  check_is_recording(folder);
  Recording recording;
  recording.folder_ = folder;
  recording.info_ = read_info(folder / "recording.yaml");
  const bool has_truth = recording.info_.has_truth;
  const auto color = read_stamp_list(folder / "color.txt");
  const auto depth = read_stamp_list(folder / "depth.txt");
  const auto poses = read_trajectory(folder / "groundtruth.txt");
  check_count(folder / "color.txt", color.size(), recording.info_.frame_count);
  check_poses(folder / "groundtruth.txt", poses, depth);
  const std::vector<std::string> images = image_paths(color, depth, has_truth);
  check_files(folder, images, has_truth);
  for (const StampedImage& image : color) {
    const std::size_t paired = nearest_in_time(depth, image.stamp_s);
    const std::string& depth_path = depth[paired].path;
    recording.entries_.push_back(
        {image.stamp_s, depth[paired].stamp_s, image.path, sibling_path(image.path, "label"),
         depth_path, sibling_path(depth_path, "depth_label"), poses[paired].T_world_base});
  }
  recording.content_hash_ = eval::content_hash(folder, images);
  return recording;
}

Frame Recording::read(int index, Channels channels) const {
  if (index < 0 || index >= frame_count())
    throw Error(fmt::format("{}: no frame {}; the recording has frames 0 to {}", folder_.string(),
                            index, frame_count() - 1));
  if (channels.depth_label && !info_.has_truth)
    throw Error(
        fmt::format("{}: made without truth; it can be mapped, not scored", folder_.string()));
  const Entry& entry = entries_[static_cast<std::size_t>(index)];
  const CameraModel& color = info_.calibration.color;
  const CameraModel& depth = info_.calibration.depth;
  Frame frame;
  frame.index = index;
  frame.stamp_s = entry.depth_stamp_s;
  frame.T_world_base = entry.T_world_base;
  if (channels.color) {
    const fs::path file = folder_ / entry.color;
    frame.color = decode_color_png(read_file(file), size_of(color), file.string());
  }
  if (channels.label) frame.label = read_grey16(folder_ / entry.label, color);
  if (channels.depth) frame.depth = read_grey16(folder_ / entry.depth, depth);
  if (channels.depth_label) frame.depth_label = read_grey16(folder_ / entry.depth_label, depth);
  return frame;
}

std::vector<Shape> Recording::read_shapes() const {
  if (!info_.has_truth)
    throw Error(
        fmt::format("{}: made without truth; it can be mapped, not scored", folder_.string()));
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
  for (const StampedImage& image : read_stamp_list(folder_ / "depth.txt"))
    stamps_s.push_back(image.stamp_s);
  return read_shape_poses(folder_ / "truth/poses.csv", read_shapes().size(), stamps_s);
}

}  // namespace mapscore::eval
