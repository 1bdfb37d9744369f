// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// Runs `gnuplot SCRIPT` in `folder`. Throws Error when gnuplot is not installed, or fails (with
/// the first line that it said).
void run_gnuplot(const std::filesystem::path& folder, const std::string& script);

}  // namespace mapscore::eval
