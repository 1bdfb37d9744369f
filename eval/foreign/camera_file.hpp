// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// Least and most depth that counts where nothing says otherwise, metres.
inline constexpr double kForeignRangeMin_m = 0.1, kForeignRangeMax_m = 10.0;

/// Cameras of a recording without recording.yaml. `text` is "fx,fy,cx,cy" in pixels, of depth that
/// is registered to colour and poses of that camera, or else a YAML file with the keys of
/// docs/foreign_recordings.md. Widths and heights are 0: the images say them. Throws Error.
[[nodiscard]] Calibration read_cameras(const std::string& text);

}  // namespace mapscore::eval
