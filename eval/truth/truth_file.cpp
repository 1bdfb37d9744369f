// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_file.hpp"

#include "core/error.hpp"

#include <bit>
#include <fstream>
#include <string>
#include <system_error>
#include <type_traits>

namespace mapscore::eval {
namespace {

/// Class as it stands in the table; ids beyond it keep their number as a name.
SemanticClass class_at(const ClassTable& table, ClassId id) {
  if (id < table.classes.size()) return table.classes[id];
  SemanticClass unknown;
  unknown.id = id;
  unknown.name = std::to_string(id);
  return unknown;
}

/// A CSV field, quoted where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::uint32_t samples_at(const VisibleTruth* visible, const SurfaceVoxel& voxel) {
  return visible == nullptr ? 0 : visible->samples(voxel.key, voxel.class_id);
}

std::string csv_of(const SurfaceTruth& truth, const VisibleTruth* visible,
                   const ClassTable& table) {
  std::string text = "i,j,k,class,touch_only,samples\n";
  const auto number = [&text](std::int64_t n, char end) {
    text += std::to_string(n);
    text += end;
  };
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    number(voxel.key.i, ',');
    number(voxel.key.j, ',');
    number(voxel.key.k, ',');
    text += field(class_at(table, voxel.class_id).name) + ',';
    number(voxel.touch_only ? 1 : 0, ',');
    number(samples_at(visible, voxel), '\n');
  }
  return text;
}

/// Appends the bytes of a number, lowest first.
template <typename Number>
void put(std::string& bytes, Number number) {
  using Bits =
      std::conditional_t<sizeof(Number) == 1, std::uint8_t,
                         std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint32_t>>;
  const auto bits = std::bit_cast<Bits>(number);
  for (unsigned byte = 0; byte < sizeof(Number); ++byte) {
    bytes += static_cast<char>(bits >> (8 * byte) & 0xffu);
  }
}

std::string ply_of(const SurfaceTruth& truth, const VisibleTruth* visible,
                   const ClassTable& table) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(truth.voxels().size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                      "property uchar green\nproperty uchar blue\nproperty ushort class\n"
                      "property uchar touch_only\nproperty uint samples\nend_header\n";
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    const Eigen::Vector3d centre = centre_of(voxel.key, truth.edge_m());
    const Colour colour = class_at(table, voxel.class_id).colour;
    for (const double x : centre) put(bytes, static_cast<float>(x));
    for (const std::uint8_t c : {colour.r, colour.g, colour.b}) put(bytes, c);
    put(bytes, voxel.class_id);
    put(bytes, static_cast<std::uint8_t>(voxel.touch_only));
    put(bytes, samples_at(visible, voxel));
  }
  return bytes;
}

void write_whole(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::path aside = file;
  aside += ".partial";
  std::ofstream out(aside, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code failure;
  if (out) std::filesystem::rename(aside, file, failure);
  if (!out || failure) {
    std::error_code ignored;
    std::filesystem::remove(aside, ignored);
    throw Error(file.string() +
                ": cannot be written; check that its folder exists, may be written " +
                "to and has room");
  }
}

}  // namespace

void write_truth(const std::filesystem::path& file, const SurfaceTruth& truth,
                 const VisibleTruth* visible, const ClassTable& table) {
  if (visible != nullptr && visible->edge_m() != truth.edge_m()) {
    throw Error("voxel_m: a visible truth of " + std::to_string(visible->edge_m()) +
                " m and a surface of " + std::to_string(truth.edge_m()) +
                " m do not match; compute both at one size");
  }
  const std::string ending = file.extension().string();
  if (ending == ".csv") return write_whole(file, csv_of(truth, visible, table));
  if (ending == ".ply") return write_whole(file, ply_of(truth, visible, table));
  throw Error(file.string() +
              ": truth is written as .csv or .ply; give the file one of these endings");
}

}  // namespace mapscore::eval
