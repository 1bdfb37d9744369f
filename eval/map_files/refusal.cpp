// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/refusal.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace mapscore::eval {

void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(fmt::format("{}: {}", file.string(), what));
}

void refuse(const std::filesystem::path& file, std::size_t line, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}", file.string(), line, what));
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string printable(text.substr(0, kLongest));
  for (char& letter : printable) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7f) letter = '?';
  }
  return fmt::format("'{}{}'", printable, text.size() > kLongest ? "..." : "");
}

}  // namespace mapscore::eval
