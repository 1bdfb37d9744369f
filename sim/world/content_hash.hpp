// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mapscore::sim {

/// XXH3 (128 bits, hexadecimal) of a file's bytes.
[[nodiscard]] std::string hash_of_bytes(std::string_view bytes);

/// XXH3 (128 bits, hexadecimal) over the bytes of scene, class file and robot, and over what they
/// compile to, which covers included files, meshes and textures: names, geoms, cameras, lights and
/// assets. Says nothing of where the files lie.
[[nodiscard]] std::string content_hash(const mjModel& model, const std::filesystem::path& scene,
                                       const std::optional<std::filesystem::path>& classes,
                                       const std::filesystem::path& robot);

}  // namespace mapscore::sim
