// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"
#include "eval/networks/network_model.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace mapscore::eval::testing {

/// A committed network of tests/network/make_models.py.
inline std::filesystem::path tiny_network(const std::string& name) {
  return std::filesystem::path(MAPSCORE_SOURCE_DIR) / "tests/network" / (name + ".onnx");
}

/// The message of the Error that `act` throws, or "accepted".
inline std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace mapscore::eval::testing
