// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/recording_writer.hpp"

#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/shape_files.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "files/refusal.hpp"
#include "files/whole_folder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

void check_size(int index, const char* image, const cv::Mat& pixels, const CameraModel& camera) {
  if (pixels.cols != camera.width_px || pixels.rows != camera.height_px)
    throw Error(
        fmt::format("frame {}: {} is {} x {}, its camera {} x {}; render it at the camera's "
                    "size",
                    index, image, pixels.cols, pixels.rows, camera.width_px, camera.height_px));
}

std::string image_name(const char* folder, int index) {
  return fmt::format("{}/{:06}.png", folder, index);
}

}  // namespace

struct RecordingWriter::State {
  State(const fs::path& of, RecordingInfo its_info) : whole(of), info(std::move(its_info)) {}

  struct Written {
    double stamp_s;
    Pose T_world_base;
    std::vector<HashedFile> images;
  };
  using Side = std::map<int, Written>;  ///< by number of the image

  WholeFolder whole;
  const fs::path &folder = whole.folder(), &partial = whole.partial();
  RecordingInfo info;
  bool has_shapes = false;
  std::mutex mutex;  // guards the sides
  Side color, depth;
  std::vector<TrajectoryPose> poses_between;

  template <class Image>
  [[nodiscard]] HashedFile write_image(const char* channel, int index, const Image& image) const {
    const std::string png = encode_png(image);
    const std::string path = image_name(channel, index);
    write_file(partial / path, png);
    return {path, hash_of(png)};
  }

  /// Takes a number of a side before its images are written.
  void claim(Side& side, const char* name, int index, const Frame& frame) {
    if (!std::isfinite(frame.stamp_s) || !frame.T_world_base.matrix().allFinite())
      refuse(folder, "{} image {}: stamp or pose is not finite", name, index);
    const std::lock_guard lock(mutex);
    if (!side.emplace(index, Written{frame.stamp_s, frame.T_world_base, {}}).second)
      refuse(folder, "{} image {} was written twice; number them from 0", name, index);
  }

  void note(Side& side, int index, std::vector<HashedFile> images) {
    const std::lock_guard lock(mutex);
    side.at(index).images = std::move(images);
  }

  void check_side(const Side& side, const char* name) const {
    if (side.empty()) refuse(folder, "no frames were written; give the drive more than none");
    const auto count = static_cast<int>(side.size());
    if (side.begin()->first != 0 || side.rbegin()->first != count - 1)
      refuse(folder, "{} images 0 to {} are not all there, {} were written; record again", name,
             side.rbegin()->first, count);
    for (const auto& [index, image] : side)
      if (image.images.empty())
        refuse(folder, "writing {} image {} failed; record again", name, index);
    for (auto image = std::next(side.begin()); image != side.end(); ++image)
      if (image->second.stamp_s <= std::prev(image)->second.stamp_s)
        refuse(folder,
               "stamp of {} image {} does not come after the one before; mend the trajectory", name,
               image->first);
  }

  void check_frames() const {
    check_side(color, "color");
    check_side(depth, "depth");
    const auto count = static_cast<int>(color.size());
    if (info.frame_count != 0 && info.frame_count != count)
      refuse(folder, "{} frames were written, {} were announced; record again", count,
             info.frame_count);
    if (info.has_truth && !has_shapes)
      refuse(folder, "surfaces were not written; write them or record without truth");
  }

  /// Poses at the stamps of both sides and between; where they share one, the depth image's.
  [[nodiscard]] std::vector<TrajectoryPose> trajectory() const {
    std::map<double, Pose> poses;
    for (const Side* side : {&depth, &color})
      for (const auto& [index, image] : *side) poses.emplace(image.stamp_s, image.T_world_base);
    for (const TrajectoryPose& pose : poses_between) poses.emplace(pose.stamp_s, pose.T_world_base);
    std::vector<TrajectoryPose> lines;
    for (const auto& [stamp_s, pose] : poses) lines.push_back({stamp_s, pose});
    return lines;
  }

  void write_lists() const {
    std::vector<HashedFile> hashes;
    const auto list = [&](const Side& side, const char* channel) {
      std::vector<StampedImage> images;
      for (const auto& [index, image] : side) {
        images.push_back({image.stamp_s, image_name(channel, index)});
        hashes.insert(hashes.end(), image.images.begin(), image.images.end());
      }
      return stamp_list_text(images);
    };
    const std::string color_list = list(color, "color");
    write_file(partial / "color.txt", color_list);
    write_file(partial / "rgb.txt", color_list);
    write_file(partial / "depth.txt", list(depth, "depth"));
    std::ranges::sort(hashes, {}, &HashedFile::path);
    write_file(partial / "groundtruth.txt", trajectory_text(trajectory()));
    write_file(partial / "hashes.txt", hash_list_text(hashes));
  }
};

RecordingWriter::RecordingWriter(const fs::path& folder, RecordingInfo info)
    : state_(std::make_unique<State>(folder, std::move(info))) {
  for (const char* channel : {"color", "depth", "label"}) make_folder(state_->partial / channel);
  if (!state_->info.has_truth) return;
  for (const char* channel : {"depth_label", "truth"}) make_folder(state_->partial / channel);
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::write_color(const Frame& frame) {
  const CameraModel& camera = state_->info.calibration.color;
  check_size(frame.index, "color", frame.color, camera);
  check_size(frame.index, "label", frame.label, camera);
  state_->claim(state_->color, "color", frame.index, frame);
  state_->note(state_->color, frame.index,
               {state_->write_image("color", frame.index, frame.color),
                state_->write_image("label", frame.index, frame.label)});
}

void RecordingWriter::write_depth(const Frame& frame) {
  const CameraModel& camera = state_->info.calibration.depth;
  const int index = frame.depth_index;
  check_size(index, "depth", frame.depth, camera);
  if (state_->info.has_truth) check_size(index, "depth_label", frame.depth_label, camera);
  state_->claim(state_->depth, "depth", index, frame);
  std::vector<HashedFile> images{state_->write_image("depth", index, frame.depth)};
  if (state_->info.has_truth)
    images.push_back(state_->write_image("depth_label", index, frame.depth_label));
  state_->note(state_->depth, index, std::move(images));
}

void RecordingWriter::write_shapes(const std::vector<Shape>& shapes, const ShapePoses& poses) {
  if (!state_->info.has_truth)
    refuse(state_->folder, "a recording without truth holds no surfaces");
  for (const Shape& shape : shapes)
    if (shape.instance >= state_->info.table.instances.size())
      refuse(state_->folder, "geom '{}': instance {} is not in the class table", shape.name,
             shape.instance);
  write_file(state_->partial / "truth/shapes.csv", shape_table_text(shapes));
  const std::string meshes = triangle_ply_bytes(shapes);
  if (!meshes.empty()) write_file(state_->partial / "truth/triangles.ply", meshes);
  if (state_->info.motion.empty() && !poses.empty())
    refuse(state_->folder, "shapes move without a motion; name it in the recording's info");
  if (!state_->info.motion.empty())
    write_file(state_->partial / "truth/poses.csv", shape_poses_text(as_filed(poses, shapes)));
  state_->has_shapes = true;
}

void RecordingWriter::write_odometry(const std::vector<OdometryPose>& poses) {
  write_file(state_->partial / "odometry.txt", odometry_text(poses));
  state_->info.odometry_count = static_cast<int>(poses.size());
}

void RecordingWriter::write_scans(const ScanLog& scans) {
  make_folder(state_->partial / "scan");
  write_file(state_->partial / "scan/scans.bin", scan_log_bytes(scans));
  state_->info.scan_count = static_cast<int>(scans.scans.size());
}

void RecordingWriter::add_poses(const std::vector<TrajectoryPose>& poses) {
  state_->poses_between.insert(state_->poses_between.end(), poses.begin(), poses.end());
}

void RecordingWriter::finish() {
  state_->check_frames();
  state_->write_lists();
  state_->info.frame_count = static_cast<int>(state_->color.size());
  write_file(state_->partial / "recording.yaml", info_text(state_->info));
  state_->whole.finish();
}

}  // namespace mapscore::eval
