// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "sim/world/world.hpp"

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace mapscore::sim::testing {

/// A folder that lives as long as a test, and scenes written into it.
class SceneFolder {
 public:
  SceneFolder() {
    static std::atomic<int> count{0};
    folder_ = std::filesystem::temp_directory_path() /
              ("mapscore_scene_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  ~SceneFolder() { std::filesystem::remove_all(folder_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

 private:
  std::filesystem::path folder_;
};

inline std::filesystem::path data_file(const std::string& name) {
  return std::filesystem::path(MAPSCORE_SOURCE_DIR) / "tests" / "data" / name;
}

/// An MJCF document of what stands in the world and, before it, of assets.
inline std::string mjcf(const std::string& world, const std::string& head = "") {
  return "<mujoco model=\"test\">" + head + "<worldbody>" + world + "</worldbody></mujoco>";
}

inline constexpr const char* kBox = "<body name='box_1'><geom type='box' size='.1 .2 .3'/></body>";

/// Loads a scene given as text, with the test robot; without class text the bodies' names decide.
inline World load_text(const std::string& scene,
                       const std::optional<std::string>& classes = std::nullopt,
                       const CameraOverrides& cameras = {}) {
  const SceneFolder folder;
  WorldFiles files{folder.write("scene.xml", scene), std::nullopt, data_file("robot.xml")};
  if (classes) files.classes = folder.write("classes.yaml", *classes);
  return World::load(files, cameras);
}

/// What a call throws as an Error.
template <typename Call>
std::string message_of(Call call) {
  try {
    (void)call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace mapscore::sim::testing
