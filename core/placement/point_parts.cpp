// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/point_parts.hpp"

#include "core/placement/voxel_index.hpp"

#include <algorithm>

namespace mapscore {
namespace {

constexpr double kCube = 0.5;       ///< in voxels
constexpr double kReach = 1 << 15;  ///< in voxels
constexpr std::uint32_t kNone = VoxelIndex::kNone;

/// Whether parts of this object would hold enough points to pay in so many draws. Looks at every
/// sixteenth pair of neighbours, and at how many of these share a cube.
bool pays(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& to_voxels,
          std::size_t draws) {
  constexpr double kLeast = 3.0;  ///< measured: draws times that share
  if (static_cast<double>(draws) <= kLeast) return false;
  const Eigen::Matrix3d to_cubes = to_voxels / kCube;
  std::size_t pairs = 0, sharing = 0;
  for (std::size_t n = 0; n + 1 < points.size(); n += 16, ++pairs) {
    const Eigen::Array3d a = to_cubes * points[n], b = to_cubes * points[n + 1];
    sharing += (a.floor() == b.floor()).all() ? 1 : 0;
  }
  return static_cast<double>(draws * sharing) > kLeast * static_cast<double>(pairs);
}

/// One object's points by cubes, numbered as they turn up.
struct Cubes {
  std::vector<std::uint32_t> of_point;  ///< kNone: out of reach
  std::vector<Eigen::AlignedBox3d> boxes;
  std::vector<std::size_t> sizes;
};

Cubes find_cubes(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& to_voxels) {
  Cubes cubes;
  cubes.of_point.reserve(points.size());
  VoxelIndex index;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d q = to_voxels * p;
    const bool within = (q.array().abs() < kReach).all();
    const std::uint32_t cube = within ? index.number(pack(voxel_of(q, kCube))) : kNone;
    cubes.of_point.push_back(cube);
    if (!within) continue;
    if (cube == cubes.boxes.size()) {
      cubes.boxes.emplace_back();
      cubes.sizes.push_back(0);
    }
    cubes.boxes[cube].extend(q);
    ++cubes.sizes[cube];
  }
  return cubes;
}

void sort_object(const std::vector<Eigen::Vector3d>& points, std::uint32_t object,
                 const Eigen::Matrix3d& to_voxels, PointParts& parts) {
  const Cubes cubes = find_cubes(points, to_voxels);
  std::vector<Eigen::Vector3d>& sorted = parts.sorted.emplace_back(points.size());
  std::vector<std::size_t> next;  // place of a cube's next point in `sorted`
  std::size_t begin = 0;
  for (const std::size_t size : cubes.sizes) {
    parts.small.push_back({object, std::span(sorted).subspan(begin, size)});
    next.push_back(begin);
    begin += size;
  }
  parts.boxes.insert(parts.boxes.end(), cubes.boxes.begin(), cubes.boxes.end());
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (const std::uint32_t cube = cubes.of_point[n]; cube != kNone)
      sorted[next[cube]++] = points[n];
    else
      parts.loose.push_back({object, std::span(points).subspan(n, 1)});
  }
}

/// What rounding may do to a coordinate, in voxels. The eight float operations on coordinates up to
/// 2 reach are off by 11 * 2^-24 reach at most; doubles within 2^20 voxels by far less than 1e-6.
double margin(int reach) {
  return 2e-6 * reach + 1e-6;
}

}  // namespace

PointParts sort_into_parts(const Observation& observation, const Eigen::Matrix3d& to_voxels,
                           std::size_t draws) {
  PointParts parts;
  for (std::uint32_t object = 0; object < observation.size(); ++object) {
    const std::vector<Eigen::Vector3d>& points = observation[object].positions;
    if (pays(points, to_voxels, draws))
      sort_object(points, object, to_voxels, parts);
    else
      parts.loose.push_back({object, points});
  }
  return parts;
}

bool PartBoxes::Draw::covered() const {
  constexpr double kMostTurn = 2.0, kMostShift = 1 << 19;
  return (turn.array().abs() <= kMostTurn).all() && (shift.array().abs() < kMostShift).all();
}

PartBoxes::Draw PartBoxes::draw_of(const Pose& T_map_sensor) const {
  return {T_map_sensor.linear() * from_voxels_ / edge_m_, T_map_sensor.translation() / edge_m_};
}

PartBoxes::PartBoxes(std::span<const Eigen::AlignedBox3d> boxes, const Eigen::Matrix3d& to_voxels,
                     std::span<const Pose> T_map_sensor, double edge_m)
    : edge_m_(edge_m), from_voxels_(to_voxels.inverse()), spread_(boxes.size()) {
  Eigen::Matrix3d widest = Eigen::Matrix3d::Zero();
  for (const Pose& pose : T_map_sensor)
    if (const Draw draw = draw_of(pose); draw.covered())
      widest = widest.cwiseMax(draw.turn.cwiseAbs());
  Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
  for (const Eigen::AlignedBox3d& box : boxes)
    farthest = farthest.cwiseMax(box.min().cwiseAbs()).cwiseMax(box.max().cwiseAbs());
  reach_ = static_cast<std::int32_t>((widest * farthest).maxCoeff()) + 2;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    for (const Eigen::AlignedBox3d& box : boxes) {
      const double half = widest.row(row).dot(0.5 * box.sizes()) + margin(reach_);
      centre_[axis].push_back(static_cast<float>(box.center()[row]));
      half_[axis].push_back(static_cast<float>(half));
    }
    low_[axis].resize(boxes.size());
    high_[axis].resize(boxes.size());
  }
}

bool PartBoxes::move_to(const Pose& T_map_sensor) {
  const Draw draw = draw_of(T_map_sensor);
  if (!draw.covered()) return false;
  const VoxelKey sensor = voxel_of(draw.shift, 1.0);
  base_ = {sensor.i - reach_, sensor.j - reach_, sensor.k - reach_};
  const Eigen::Vector3d shift = draw.shift - Eigen::Vector3d(base_.i, base_.j, base_.k);
  std::fill(spread_.begin(), spread_.end(), 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    move_axis(axis, draw.turn.row(row).cast<float>(), static_cast<float>(shift[row]));
  }
  return true;
}

/// Plain arrays, so that the compiler makes vectors of them. Coordinates are positive, so that a
/// cast is their floor.
void PartBoxes::move_axis(std::size_t axis, const Eigen::RowVector3f& turn, float shift) {
  const float *x = centre_[0].data(), *y = centre_[1].data(), *z = centre_[2].data();
  const float *half = half_[axis].data(), to_x = turn[0], to_y = turn[1], to_z = turn[2];
  std::int32_t *low = low_[axis].data(), *high = high_[axis].data(), *spread = spread_.data();
  for (std::size_t n = 0; n < spread_.size(); ++n) {
    const float centre = to_x * x[n] + to_y * y[n] + to_z * z[n] + shift;
    low[n] = static_cast<std::int32_t>(centre - half[n]);
    high[n] = static_cast<std::int32_t>(centre + half[n]);
    spread[n] |= low[n] ^ high[n];
  }
}

}  // namespace mapscore
