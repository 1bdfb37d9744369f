// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// Throws Error "FILE: WHAT".
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what);
/// Throws Error "FILE:LINE: WHAT"; lines count from 1.
[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line,
                         const std::string& what);

/// A text of the file for a message of one line: in single quotes, cut when long, with what is not
/// printable ASCII or part of UTF-8 as '?'.
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace mapscore::eval
