// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/error_ply.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "eval/recording/little_endian.hpp"

#include <cstdint>
#include <cstring>

namespace mapscore::eval {
namespace {

constexpr const char* kProperties =
    "property float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property ushort class\nproperty uchar verdict\nend_header\n";
constexpr std::size_t kVertexBytes = 3 * sizeof(float) + 3 + sizeof(ClassId) + 1;

std::string header_of(const JudgedMap& map) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment verdict";
  for (const Verdict verdict : kVerdicts) {
    header += ' ' + std::to_string(static_cast<int>(verdict)) + ' ';
    header += name_of(verdict);
  }
  return header + "\nelement vertex " + std::to_string(map.voxels.size()) + '\n' + kProperties;
}

}  // namespace

std::string error_ply_bytes(const JudgedMap& map) {
  std::string bytes = header_of(map);
  bytes.reserve(bytes.size() + map.voxels.size() * kVertexBytes);
  for (const JudgedVoxel& voxel : map.voxels) {
    for (const double x : centre_of(voxel.key, map.edge_m))
      append_little_endian(bytes, static_cast<float>(x));
    const Colour colour = colour_of(voxel.verdict);
    for (const std::uint8_t channel : {colour.r, colour.g, colour.b})
      append_little_endian(bytes, channel);
    append_little_endian(bytes, voxel.class_id);
    append_little_endian(bytes, static_cast<std::uint8_t>(voxel.verdict));
  }
  return bytes;
}

void write_error_ply(const std::filesystem::path& file, const JudgedMap& map) {
  if (file.extension() != ".ply")
    throw Error(file.string() + ": errors are written as .ply; give the file this ending");
  write_whole_file(file, error_ply_bytes(map));
}

}  // namespace mapscore::eval
