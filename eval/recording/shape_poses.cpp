// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/shape_poses.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

namespace mapscore::eval {
namespace {

constexpr const char* kShapePoseHeader = "stamp_s,shape,px,py,pz,qx,qy,qz,qw";
constexpr std::size_t kShapePoseColumns = 9;

/// Takes the lines of a file one by one.
class PoseLines {
 public:
  PoseLines(const std::filesystem::path& file, std::size_t shape_count,
            const std::vector<double>& stamps_s)
      : file_(file), shape_count_(shape_count), stamps_s_(stamps_s) {}

  void take(const std::string& line) {
    ++number_;
    const auto numbers = parse_numbers(line, kShapePoseColumns + 1);
    if (!numbers || numbers->size() != kShapePoseColumns || line.ends_with(','))
      refuse(fmt::format("expected {} finite numbers", kShapePoseColumns));
    take_shape((*numbers)[0], (*numbers)[1]);
    PoseNumbers of_pose{};
    std::copy(numbers->begin() + 2, numbers->end(), of_pose.begin());
    const auto pose = pose_of(of_pose);
    if (!pose) refuse("quaternion is not of length 1");
    poses_.T_world_shape.push_back(*pose);
  }

  ShapePoses finish() {
    if (poses_.empty()) return {};
    if (poses_.T_world_shape.size() != poses_.shapes.size() * stamps_s_.size())
      refuse(fmt::format("{} poses for {} shapes and {} depth images", poses_.T_world_shape.size(),
                         poses_.shapes.size(), stamps_s_.size()));
    poses_.stamps_s = stamps_s_;
    return std::move(poses_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    mapscore::refuse(file_, number_, "{}; mend the line or record again", what);
  }

  /// The first stamp's lines say which shapes move, those of the others must repeat them.
  void take_shape(double stamp_s, double shape) {
    if (!(shape >= 0 && shape < static_cast<double>(shape_count_) && shape == std::floor(shape)))
      refuse(fmt::format("shape {} is not in shapes.csv and triangles.ply", shape));
    const auto position = static_cast<std::size_t>(shape);
    if (stamp_s == stamps_s_.front()) {
      if (!poses_.empty() && position <= poses_.shapes.back())
        refuse(
            fmt::format("shape {} does not come after shape {}", position, poses_.shapes.back()));
      poses_.shapes.push_back(position);
      return;
    }
    const std::size_t line = poses_.T_world_shape.size();
    const std::size_t image = poses_.empty() ? 0 : line / poses_.shapes.size();
    if (image >= stamps_s_.size() || stamp_s != stamps_s_[image])
      refuse(fmt::format("stamp {} where another of depth.txt should stand", stamp_s));
    if (position != poses_.shapes[line % poses_.shapes.size()])
      refuse(fmt::format("shape {} where another should stand", position));
  }

  const std::filesystem::path& file_;
  std::size_t shape_count_;
  const std::vector<double>& stamps_s_;
  std::size_t number_ = 1;
  ShapePoses poses_;
};

}  // namespace

std::size_t ShapePoses::nearest(double stamp_s) const {
  const auto after = std::lower_bound(stamps_s.begin(), stamps_s.end(), stamp_s);
  if (after == stamps_s.begin()) return 0;
  const bool later = after != stamps_s.end() && *after - stamp_s < stamp_s - *std::prev(after);
  return static_cast<std::size_t>((later ? after : std::prev(after)) - stamps_s.begin());
}

std::vector<Shape> ShapePoses::moved(const std::vector<Shape>& all, std::size_t at) const {
  std::vector<Shape> result;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    result.push_back(all.at(shapes[i]));
    result.back().T_world_shape = T_world_shape.at(at * shapes.size() + i);
  }
  return result;
}

std::vector<Shape> ShapePoses::fixed(const std::vector<Shape>& all) const {
  std::vector<Shape> result;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!std::binary_search(shapes.begin(), shapes.end(), i)) result.push_back(all[i]);
  return result;
}

std::vector<Shape> ShapePoses::at(std::vector<Shape> all, std::size_t at) const {
  for (std::size_t i = 0; i < shapes.size(); ++i)
    all.at(shapes[i]).T_world_shape = T_world_shape.at(at * shapes.size() + i);
  return all;
}

ShapePoses poses_of_moving(const std::vector<Shape>& all, std::vector<double> stamps_s,
                           const std::vector<std::vector<Pose>>& T_world_shape) {
  ShapePoses poses;
  for (std::size_t shape = 0; shape < all.size(); ++shape) {
    const auto leaves = [&](const std::vector<Pose>& at) {
      return at.at(shape).matrix() != all[shape].T_world_shape.matrix();
    };
    if (std::any_of(T_world_shape.begin(), T_world_shape.end(), leaves))
      poses.shapes.push_back(shape);
  }
  if (poses.empty()) return poses;
  for (const std::vector<Pose>& at : T_world_shape)
    for (const std::size_t shape : poses.shapes) poses.T_world_shape.push_back(at[shape]);
  poses.stamps_s = std::move(stamps_s);
  return poses;
}

ShapePoses as_filed(const ShapePoses& poses, const std::vector<Shape>& all) {
  std::vector<std::size_t> order(all.size()), filed(all.size());  // by place there, by place here
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return all[i].kind != ShapeKind::mesh; });
  for (std::size_t place = 0; place < order.size(); ++place) filed[order[place]] = place;
  std::vector<std::size_t> columns(poses.shapes.size());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  std::sort(columns.begin(), columns.end(), [&](std::size_t a, std::size_t b) {
    return filed[poses.shapes[a]] < filed[poses.shapes[b]];
  });
  ShapePoses result;
  result.stamps_s = poses.stamps_s;
  for (const std::size_t column : columns) result.shapes.push_back(filed[poses.shapes[column]]);
  for (std::size_t at = 0; at < poses.stamps_s.size(); ++at)
    for (const std::size_t column : columns) {
      const Shape& shape = all[poses.shapes[column]];
      const Pose& pose = poses.T_world_shape[at * columns.size() + column];
      const bool mesh = shape.kind == ShapeKind::mesh;
      result.T_world_shape.push_back(mesh ? pose * shape.T_world_shape.inverse() : pose);
    }
  return result;
}

std::string shape_poses_text(const ShapePoses& poses) {
  std::string text = fmt::format("{}\n", kShapePoseHeader);
  for (std::size_t at = 0; at < poses.stamps_s.size(); ++at)
    for (std::size_t i = 0; i < poses.shapes.size(); ++i) {
      const PoseNumbers pose = numbers_of(poses.T_world_shape[at * poses.shapes.size() + i]);
      if (!pose_of(pose))
        throw Error(fmt::format("shape {} at {} s: pose is not finite; mend the motion",
                                poses.shapes[i], poses.stamps_s[at]));
      text +=
          fmt::format("{},{},{}\n", poses.stamps_s[at], poses.shapes[i], join_numbers(pose, ","));
    }
  return text;
}

ShapePoses read_shape_poses(const std::filesystem::path& file, std::size_t shape_count,
                            const std::vector<double>& depth_stamps_s) {
  std::istringstream text(read_file(file));
  std::string line;
  if (!std::getline(text, line) || line != kShapePoseHeader)
    refuse(file, 1, "the first line is not '{}'; record again", kShapePoseHeader);
  PoseLines lines(file, shape_count, depth_stamps_s);
  while (std::getline(text, line)) lines.take(line);
  return lines.finish();
}

}  // namespace mapscore::eval
