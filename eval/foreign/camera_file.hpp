// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <optional>
#include <string>

namespace mapscore::eval {

/// What is believed of the cameras of a folder whose recording.yaml does not say it, or says it
/// wrong (docs/foreign_recordings.md, Cameras).
struct BelievedCameras {
  Calibration calibration;   ///< the images say widths and heights, whatever is read
  double time_offset_s = 0;  ///< labels were seen this long after their stamps say
};

/// `text` is "fx,fy,cx,cy" in pixels, of the colour camera, or else a YAML file. What it leaves
/// out is as in `otherwise`, which is what the folder itself says of its cameras; without it, depth
/// is registered to colour and poses are those of that camera. Throws Error.
[[nodiscard]] BelievedCameras read_cameras(const std::string& text,
                                           const std::optional<Calibration>& otherwise = {});

/// The text of such a file, which reads back as the same but for the last digits of rotations.
[[nodiscard]] std::string cameras_file_text(const BelievedCameras& cameras);

}  // namespace mapscore::eval
