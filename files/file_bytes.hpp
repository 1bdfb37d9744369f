// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mapscore {

/// All bytes of a file. Throws Error when it is missing or cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Writes a file and looks at the result of writing, flushing and closing, so that a full disk is
/// noticed. Throws Error naming the file and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it. Throws Error naming it.
void make_folder(const std::filesystem::path& folder);

/// Puts `file` at `place` too, by a hard link, or where there can be none by a copy. Throws Error
/// naming the place when neither can be made.
void link_or_copy(const std::filesystem::path& file, const std::filesystem::path& place);

/// XXH3, 128 bits, as 32 lower-case hexadecimal digits.
[[nodiscard]] std::string hash_of(std::string_view bytes);

}  // namespace mapscore
