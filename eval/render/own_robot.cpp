// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/render/own_robot.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace mapscore::eval {

namespace fs = std::filesystem;

std::optional<fs::path> own_robot_of(const fs::path& folder) {
  for (const char* way : {"../share/mapscore/scenes/robot.xml", "../../scenes/robot.xml"}) {
    fs::path file = (folder / way).lexically_normal();
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

bool names_base_footprint(const fs::path& robot) {
  std::ifstream stream(robot, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return text.find("\"base_footprint\"") != std::string::npos ||
         text.find("'base_footprint'") != std::string::npos;
}

std::optional<fs::path> own_robot() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? std::nullopt : own_robot_of(program.parent_path());
}

}  // namespace mapscore::eval
