// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string_view>

namespace mapscore::eval {

/// Writes FILE.partial and renames it, so that a file of this name is whole; nothing is left behind
/// after a failure. Throws Error naming the file.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace mapscore::eval
