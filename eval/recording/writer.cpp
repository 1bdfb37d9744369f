// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/error.hpp"
#include "eval/recording/file_bytes.hpp"
#include "eval/recording/image_files.hpp"
#include "eval/recording/info_yaml.hpp"
#include "eval/recording/png.hpp"
#include "eval/recording/recording.hpp"
#include "eval/recording/shape_table.hpp"
#include "eval/recording/stamp_list.hpp"
#include "eval/recording/triangle_ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// Absolute, without `.`, `..` and a closing slash, so that a suffix can be appended.
fs::path normal(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& what) {
  throw Error(fmt::format("{}: {}", folder.string(), what));
}

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    refuse(folder, fmt::format("cannot create the folder ({}); give another", error.message()));
}

void check_absent(const fs::path& folder) {
  if (fs::exists(fs::symlink_status(folder)))
    refuse(folder, "exists already; remove it or give another folder");
}

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
  struct Written {
    double stamp_s;
    Pose T_world_base;
    std::vector<HashedFile> images;
  };

  fs::path folder, partial;
  RecordingInfo info;
  bool has_shapes = false, finished = false;
  std::mutex mutex;  // guards `frames`
  std::map<int, Written> frames;

  template <class Image>
  [[nodiscard]] HashedFile write_image(const char* channel, int index, const Image& image) const {
    const std::string png = encode_png(image);
    const std::string path = image_name(channel, index);
    write_file(partial / path, png);
    return {path, hash_of(png)};
  }

  void check_frames() const {
    if (frames.empty()) refuse(folder, "no frames were written; give the drive more than none");
    const auto count = static_cast<int>(frames.size());
    if (frames.begin()->first != 0 || frames.rbegin()->first != count - 1)
      refuse(folder, fmt::format("frames 0 to {} are not all there, {} were written; record again",
                                 frames.rbegin()->first, count));
    if (info.frame_count != 0 && info.frame_count != count)
      refuse(folder, fmt::format("{} frames were written, {} were announced; record again", count,
                                 info.frame_count));
    for (const auto& [index, frame] : frames)
      if (frame.images.empty())
        refuse(folder, fmt::format("writing frame {} failed; record again", index));
    if (info.has_truth && !has_shapes)
      refuse(folder, "surfaces were not written; write them or record without truth");
    for (auto frame = std::next(frames.begin()); frame != frames.end(); ++frame)
      if (frame->second.stamp_s <= std::prev(frame)->second.stamp_s)
        refuse(folder, fmt::format("stamp of frame {} does not come after the one before; mend the "
                                   "trajectory",
                                   frame->first));
  }

  void write_lists() const {
    std::vector<StampedImage> color, depth;
    std::vector<TrajectoryPose> poses;
    std::vector<HashedFile> hashes;
    for (const auto& [index, frame] : frames) {
      color.push_back({frame.stamp_s, image_name("color", index)});
      depth.push_back({frame.stamp_s, image_name("depth", index)});
      poses.push_back({frame.stamp_s, frame.T_world_base});
      hashes.insert(hashes.end(), frame.images.begin(), frame.images.end());
    }
    std::sort(hashes.begin(), hashes.end(),
              [](const HashedFile& a, const HashedFile& b) { return a.path < b.path; });
    write_file(partial / "color.txt", stamp_list_text(color));
    write_file(partial / "rgb.txt", stamp_list_text(color));
    write_file(partial / "depth.txt", stamp_list_text(depth));
    write_file(partial / "groundtruth.txt", trajectory_text(poses));
    write_file(partial / "hashes.txt", hash_list_text(hashes));
  }
};

RecordingWriter::RecordingWriter(const fs::path& folder, RecordingInfo info)
    : state_(std::make_unique<State>()) {
  state_->folder = normal(folder);
  state_->partial = state_->folder.string() + ".partial";
  state_->info = std::move(info);
  check_absent(state_->folder);
  std::error_code ignored;
  fs::remove_all(state_->partial,
                 ignored);  // what a crash left; creating says what is wrong with it
  for (const char* channel : {"color", "depth", "label"}) create(state_->partial / channel);
  if (!state_->info.has_truth) return;
  for (const char* channel : {"depth_label", "truth"}) create(state_->partial / channel);
}

RecordingWriter::~RecordingWriter() {
  std::error_code ignored;
  if (!state_->finished) fs::remove_all(state_->partial, ignored);
}

void RecordingWriter::write(const Frame& frame) {
  const Calibration& cameras = state_->info.calibration;
  check_size(frame.index, "color", frame.color, cameras.color);
  check_size(frame.index, "label", frame.label, cameras.color);
  check_size(frame.index, "depth", frame.depth, cameras.depth);
  if (state_->info.has_truth)
    check_size(frame.index, "depth_label", frame.depth_label, cameras.depth);
  if (!std::isfinite(frame.stamp_s) || !frame.T_world_base.matrix().allFinite())
    refuse(state_->folder, fmt::format("frame {}: stamp or pose is not finite", frame.index));
  {
    const std::lock_guard lock(state_->mutex);
    const State::Written claimed{frame.stamp_s, frame.T_world_base, {}};
    if (!state_->frames.emplace(frame.index, claimed).second)
      refuse(state_->folder,
             fmt::format("frame {} was written twice; number the frames from 0", frame.index));
  }
  std::vector<HashedFile> images{state_->write_image("color", frame.index, frame.color),
                                 state_->write_image("label", frame.index, frame.label),
                                 state_->write_image("depth", frame.index, frame.depth)};
  if (state_->info.has_truth)
    images.push_back(state_->write_image("depth_label", frame.index, frame.depth_label));
  const std::lock_guard lock(state_->mutex);
  state_->frames.at(frame.index).images = std::move(images);
}

void RecordingWriter::write_shapes(const std::vector<Shape>& shapes, const ShapePoses& poses) {
  if (!state_->info.has_truth)
    refuse(state_->folder, "a recording without truth holds no surfaces");
  for (const Shape& shape : shapes)
    if (shape.instance >= state_->info.table.instances.size())
      refuse(state_->folder, fmt::format("geom '{}': instance {} is not in the class table",
                                         shape.name, shape.instance));
  write_file(state_->partial / "truth/shapes.csv", shape_table_text(shapes));
  const std::string meshes = triangle_ply_bytes(shapes);
  if (!meshes.empty()) write_file(state_->partial / "truth/triangles.ply", meshes);
  if (state_->info.motion.empty() && !poses.empty())
    refuse(state_->folder, "shapes move without a motion; name it in the recording's info");
  if (!state_->info.motion.empty())
    write_file(state_->partial / "truth/poses.csv", shape_poses_text(as_filed(poses, shapes)));
  state_->has_shapes = true;
}

void RecordingWriter::finish() {
  state_->check_frames();
  state_->write_lists();
  state_->info.frame_count = static_cast<int>(state_->frames.size());
  write_file(state_->partial / "recording.yaml", info_text(state_->info));
  check_absent(state_->folder);
  std::error_code error;
  fs::rename(state_->partial, state_->folder, error);
  if (error)
    refuse(state_->folder, fmt::format("cannot be renamed from {} ({}); give another folder",
                                       state_->partial.string(), error.message()));
  state_->finished = true;
}

}  // namespace mapscore::eval
