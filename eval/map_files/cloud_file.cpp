// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/cloud_file.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/recording/little_endian.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace mapscore::eval {
namespace {

std::string ply_header(std::size_t count) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uint label\nproperty uint instance\nend_header\n",
      count);
}

std::string pcd_header(std::size_t count) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
      "FIELDS x y z label instance\nSIZE 4 4 4 4 4\nTYPE F F F U U\nCOUNT 1 1 1 1 1\n"
      "WIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      count);
}

}  // namespace

void write_cloud(const std::filesystem::path& file, std::span<const Eigen::Vector3d> points,
                 ClassId class_id, InstanceId instance) {
  const bool ply = file.extension() == ".ply";
  if (!ply && file.extension() != ".pcd")
    throw Error(file.string() +
                ": clouds are written as .ply or .pcd; give the file one of these endings");
  std::string bytes = ply ? ply_header(points.size()) : pcd_header(points.size());
  for (const Eigen::Vector3d& p : points) {
    for (const double x : p) append_little_endian(bytes, static_cast<float>(x));
    append_little_endian(bytes, std::uint32_t{class_id});
    append_little_endian(bytes, std::uint32_t{instance});
  }
  write_whole_file(file, bytes);
}

}  // namespace mapscore::eval
