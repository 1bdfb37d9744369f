// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/recording/recording.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace mapscore {
struct YamlValue;
}

namespace mapscore::eval {

/// recording.yaml as docs/formats.md describes it. Numbers are written so that they read back as
/// the same doubles.
[[nodiscard]] std::string info_text(const RecordingInfo& info);

/// Throws Error with file, line and key path for another format version, an unknown, missing or
/// doubled key, a number that is not finite or out of range, and ids that do not fit the class
/// table.
[[nodiscard]] RecordingInfo read_info(const std::filesystem::path& file);

// Parts of recording.yaml that stand in other files too.

/// The lines `color` and `depth`.
[[nodiscard]] std::string cameras_text(const Calibration& calibration, double color_rate_hz,
                                       double depth_rate_hz);
/// Those, and the poses T_color_depth and T_base_depth. Throws Error naming the place.
[[nodiscard]] Calibration calibration_of(const YamlValue& root);
/// The list `classes`, from its key on.
[[nodiscard]] std::string classes_text(const std::vector<SemanticClass>& classes);
/// From the value of that key. Throws Error naming the place.
[[nodiscard]] std::vector<SemanticClass> classes_of(const YamlValue& value);

}  // namespace mapscore::eval
