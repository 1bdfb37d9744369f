// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/geometry/camera.hpp"

#include <string>

namespace mapscore::eval {

/// What is believed of the cameras of a folder whose recording.yaml does not say it, or says it
/// wrong (docs/foreign_recordings.md, Cameras).
struct BelievedCameras {
  Calibration calibration;   ///< widths and heights are 0 as read: the images say them
  double time_offset_s = 0;  ///< labels were seen this long after their stamps say
};

/// `text` is "fx,fy,cx,cy" in pixels, of depth that is registered to colour and poses of that
/// camera, or else a YAML file. Throws Error.
[[nodiscard]] BelievedCameras read_cameras(const std::string& text);

/// The text of such a file, which reads back as the same but for the last digits of rotations.
[[nodiscard]] std::string cameras_file_text(const BelievedCameras& cameras);

}  // namespace mapscore::eval
