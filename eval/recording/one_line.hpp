// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace mapscore::eval {

/// A text that a file may have a hand in, fit for a message of one line: control characters, ends
/// of lines among them, become '?'.
[[nodiscard]] inline std::string one_line(std::string text) {
  for (char& letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f) letter = '?';
  }
  return text;
}

}  // namespace mapscore::eval
