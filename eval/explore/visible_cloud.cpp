// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/explore/visible_cloud.hpp"

#include "core/geometry/depth_rays.hpp"
#include "core/geometry/voxel.hpp"
#include "core/whole_file.hpp"
#include "eval/truth/sample_counter.hpp"
#include "files/file_bytes.hpp"
#include "files/little_endian.hpp"

#include <string_view>

namespace mapscore::eval {
namespace {

constexpr std::string_view kMagic = "mapscore visible cloud 1\n";
constexpr std::size_t kPointBytes = 3 * sizeof(float) + sizeof(InstanceId);
constexpr std::size_t kHashBytes = 32;

}  // namespace

void VisibleCloud::add(const Frame& frame, const Calibration& truth) {
  check_depth_images(frame, truth.depth);
  const DepthRays rays(truth.depth);
  const Pose T_world_depth = frame.T_world_base * truth.T_base_depth;
  for (int v = 0; v < frame.depth.rows; ++v) {
    for (int u = 0; u < frame.depth.cols; ++u) {
      const double z_m = frame.depth(v, u) / kDepthUnitsPerMetre;
      if (z_m == 0.0 || z_m < truth.range_min_m || z_m > truth.range_max_m) continue;
      const Eigen::Vector3d p_world = T_world_depth * rays.point(u, v, z_m);
      const InstanceId instance = frame.depth_label(v, u);
      const auto cube = packable_voxel_of(p_world, cell_m_);
      if (!cube) continue;
      const std::uint64_t mark = mix_bits(pack(*cube)) ^ mix_bits(instance + 1ULL);
      if (taken_.insert(mark).second) points_.push_back({p_world.cast<float>(), instance});
    }
  }
}

std::string cloud_bytes(const std::vector<SurfacePoint>& points) {
  std::string bytes(kMagic);
  for (const SurfacePoint& point : points) {
    for (const float x : point.p_world) append_little_endian(bytes, x);
    append_little_endian(bytes, point.instance);
  }
  return bytes + hash_of(bytes);
}

std::optional<std::vector<SurfacePoint>> cloud_of_bytes(const std::string& bytes) {
  if (bytes.size() < kMagic.size() + kHashBytes || !bytes.starts_with(kMagic)) return std::nullopt;
  std::string_view body(bytes.data(), bytes.size() - kHashBytes);
  if (hash_of(body) != bytes.substr(body.size())) return std::nullopt;
  body.remove_prefix(kMagic.size());
  std::vector<SurfacePoint> points(body.size() / kPointBytes);
  for (SurfacePoint& point : points) {
    for (float& x : point.p_world) x = take_little_endian<float>(body);
    point.instance = take_little_endian<InstanceId>(body);
  }
  return points;
}

std::vector<SurfacePoint> kept_cloud(const std::filesystem::path& file,
                                     const std::function<std::vector<SurfacePoint>()>& make) {
  if (std::filesystem::exists(file))
    if (auto points = cloud_of_bytes(read_file(file))) return std::move(*points);
  std::vector<SurfacePoint> points = make();
  make_folder(file.parent_path());
  write_whole_file(file, cloud_bytes(points));
  return points;
}

}  // namespace mapscore::eval
