// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "core/objects/map_object.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::eval {

/// Version of the layout of objects.yaml; a reader refuses any other.
inline constexpr int kObjectFileFormat = 1;

/// An object map on disk (docs/objects.md): its objects, ascending by id, in a map frame that lies
/// in the scene's world as a study's does.
struct ObjectFile {
  Eigen::Vector3d map_origin_m = Eigen::Vector3d::Zero();
  double map_yaw_deg = 0.0;
  std::vector<MapObject> objects;

  [[nodiscard]] Pose T_world_map() const;
};

/// The text of objects.yaml; classes by their names in `table`. Throws Error when an object has no
/// class of the table.
[[nodiscard]] std::string object_text(const ObjectFile& file, const ClassTable& table);

/// Writes it aside and renames. Throws Error naming the file.
void write_objects(const std::filesystem::path& path, const ObjectFile& file,
                   const ClassTable& table);

/// Throws Error with file, line and key when the file is missing or broken, has an unknown key or
/// class, or a value out of range.
[[nodiscard]] ObjectFile read_objects(const std::filesystem::path& path, const ClassTable& table);

}  // namespace mapscore::eval
