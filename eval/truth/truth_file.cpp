// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/truth/truth_file.hpp"

#include "core/error.hpp"
#include "core/whole_file.hpp"
#include "files/csv.hpp"

#include <fmt/format.h>

#include <bit>
#include <ostream>
#include <string>
#include <vector>

namespace mapscore::eval {
namespace {

/// The classes as they stand in the table; ids of the truth beyond it have their number as a name.
std::vector<SemanticClass> classes_of(const SurfaceTruth& truth, const ClassTable& table) {
  std::vector<SemanticClass> classes = table.classes;
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    while (voxel.class_id >= classes.size()) {
      SemanticClass unknown;
      unknown.id = static_cast<ClassId>(classes.size());
      unknown.name = std::to_string(unknown.id);
      classes.push_back(std::move(unknown));
    }
  }
  return classes;
}

std::uint32_t samples_at(const VisibleTruth* visible, const SurfaceVoxel& voxel) {
  return visible == nullptr ? 0 : visible->samples(voxel.key, voxel.class_id);
}

/// Writes what has gathered and empties it when there is enough of it, so that a truth of any size
/// takes no memory for its text.
void take(std::ostream& out, std::string& bytes, std::size_t enough = 1 << 16) {
  if (bytes.size() < enough) return;
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.clear();
}

void write_csv(std::ostream& out, const SurfaceTruth& truth, const VisibleTruth* visible,
               const std::vector<std::string>& names) {
  std::string text = "i,j,k,class,touch_only,samples\n";
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    text += fmt::format("{},{},{},{},{:d},{}\n", voxel.key.i, voxel.key.j, voxel.key.k,
                        names.at(voxel.class_id), voxel.touch_only, samples_at(visible, voxel));
    take(out, text);
  }
  take(out, text, 0);
}

/// Appends the bytes of a number, lowest first.
template <typename Number>
void put(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void write_ply(std::ostream& out, const SurfaceTruth& truth, const VisibleTruth* visible,
               const std::vector<SemanticClass>& classes) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(truth.voxels().size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                      "property uchar green\nproperty uchar blue\nproperty ushort class\n"
                      "property uchar touch_only\nproperty uint samples\nend_header\n";
  for (const SurfaceVoxel& voxel : truth.voxels()) {
    const Eigen::Vector3d centre = centre_of(voxel.key, truth.edge_m());
    const Colour& colour = classes.at(voxel.class_id).colour;
    for (const double x : centre) put(bytes, static_cast<float>(x));
    for (const std::uint8_t c : {colour.r, colour.g, colour.b}) put(bytes, c);
    put(bytes, voxel.class_id);
    put(bytes, static_cast<std::uint8_t>(voxel.touch_only));
    put(bytes, samples_at(visible, voxel));
    take(out, bytes);
  }
  take(out, bytes, 0);
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
  if (ending != ".csv" && ending != ".ply") {
    throw Error(file.string() +
                ": truth is written as .csv or .ply; give the file one of these endings");
  }
  const std::vector<SemanticClass> classes = classes_of(truth, table);
  WholeFile whole(file);
  if (ending == ".csv") {
    std::vector<std::string> names;
    for (const SemanticClass& c : classes) names.push_back(csv_cell(c.name));
    write_csv(whole.stream(), truth, visible, names);
  } else {
    write_ply(whole.stream(), truth, visible, classes);
  }
  whole.finish();
}

}  // namespace mapscore::eval
