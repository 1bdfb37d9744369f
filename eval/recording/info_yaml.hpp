// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"

#include <filesystem>
#include <string>

namespace mapscore::eval {

/// recording.yaml as docs/formats.md describes it. Numbers are written so that they read back as
/// the same doubles.
[[nodiscard]] std::string info_text(const RecordingInfo& info);

/// Throws Error with file, line and key path for another format version, an unknown, missing or
/// doubled key, a number that is not finite or out of range, and ids that do not fit the class
/// table.
[[nodiscard]] RecordingInfo read_info(const std::filesystem::path& file);

}  // namespace mapscore::eval
