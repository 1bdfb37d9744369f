// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <stdexcept>
#include <string>

namespace mapscore {

/// The one exception of mapscore: the input is wrong. Thrown at the boundary (files, configuration,
/// scenes, parameters). The message is one line: where it is wrong, what is wrong, how to mend it.
/// The program prints it and ends with exit code 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace mapscore
