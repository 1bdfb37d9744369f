// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/lab/commands/command_map.hpp"

#include "core/error.hpp"
#include "eval/map_files/lattice_map.hpp"
#include "eval/map_files/legend.hpp"
#include "eval/map_files/map_file.hpp"
#include "eval/score/surface_share.hpp"

#include <fmt/format.h>

#include <mutex>
#include <utility>

namespace mapscore::eval {
namespace {

namespace fs = std::filesystem;

/// A row of text takes some ten times its bytes while it is read.
constexpr std::uintmax_t kMostBytes = 256 << 20;

/// Fewer voxels may lie anywhere.
constexpr std::size_t kFewestOfAFrame = 10;

void check_file(const fs::path& file) {
  std::error_code none;
  const fs::file_status status = fs::symlink_status(file, none);
  const std::string name = file.filename().string();
  if (none || !fs::exists(status)) throw Error(fmt::format("it wrote no {}", name));
  if (!fs::is_regular_file(status)) throw Error(fmt::format("its {} is no file", name));
  if (const std::uintmax_t bytes = fs::file_size(file, none); bytes > kMostBytes)
    throw Error(fmt::format("its {} has {} bytes, more than {}", name, bytes, kMostBytes));
}

/// None where the file says that it holds none, as after frames without a detection.
std::vector<MapVoxel> read_voxels(const fs::path& file, const ClassTable& table,
                                  double edge_m) try {
  // One at a time: a small octree can hold fifty million voxels.
  static std::mutex reading;
  const std::lock_guard lock(reading);
  const MapFile map = read_map_file(file);
  if (map.label_kind == LabelKind::none)
    throw Error(fmt::format("{}: has no classes; write one for each voxel", file.string()));
  return on_lattice(map, apply_legend(map, std::nullopt, table).classes, Pose::Identity(), edge_m,
                    Resample::refuse)
      .voxels;
} catch (const EmptyMap&) {
  return {};
}

}  // namespace

MapSnapshot read_command_map(const fs::path& file, const ClassTable& table, double edge_m,
                             const SurfaceTruth& surface) {
  check_file(file);
  std::vector<MapVoxel> voxels = read_voxels(file, table, edge_m);
  for (MapVoxel& voxel : voxels)
    if (!table.detected(voxel.best_class)) voxel.best_class = kBackground;
  MapSnapshot map(std::move(voxels));
  const SurfaceShare at = surface_share(map, surface);
  if (at.occupied >= kFewestOfAFrame && at.in_another_frame())
    throw Error(fmt::format(
        "its map seems to lie in another frame: only {} of {} occupied voxels lie on or beside a "
        "surface; map in the frame of poses.txt, on the lattice through its origin",
        at.at_surfaces, at.occupied));
  return map;
}

}  // namespace mapscore::eval
