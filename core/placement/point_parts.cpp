// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/placement/point_parts.hpp"

#include "core/placement/voxel_index.hpp"

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
    const std::uint32_t cube = within ? index.number(voxel_of(q, kCube)) : kNone;
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

}  // namespace mapscore
