// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace mapscore::eval {

/// Width and height by the header of a PNG, each from 1 to 16384. `name` opens the message of the
/// Error. Decoding checks the rest.
[[nodiscard]] cv::Size png_size(std::string_view bytes, const std::string& name);

}  // namespace mapscore::eval
