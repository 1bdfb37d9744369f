// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>

namespace mapscore {

/// Writes aside and renames, so that a full disk never leaves half a file under the name asked for.
/// `write` says whether it succeeded. Throws Error.
void write_whole(const std::filesystem::path& file,
                 const std::function<bool(std::ostream&)>& write);

}  // namespace mapscore
