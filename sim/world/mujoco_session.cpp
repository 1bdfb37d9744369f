// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/world/mujoco_session.hpp"

#include "core/error.hpp"

#include <mutex>

namespace mapscore::sim {
namespace {

/// MuJoCo asks that an error handler does not return.
[[noreturn]] void raise(const char* message) {
  throw Error("MuJoCo: " + one_line(message));
}

void drop(const char*) {}

}  // namespace

void quiet_mujoco() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (!mju_user_error) mju_user_error = raise;
    if (!mju_user_warning) mju_user_warning = drop;
  });
}

std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += "; ";
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == ';')) line.pop_back();
  return line;
}

}  // namespace mapscore::sim
