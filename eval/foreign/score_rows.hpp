// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace mapscore::eval {

/// Scores of an image's detections by their pixel value.
using ScoreOfValue = std::map<std::uint16_t, double>;

/// By frame, the rows of a CSV `image,id,score` or `stamp_s,id,score`. `images`: the label image of
/// each frame; `stamps_s`: its stamp, ascending. A row's stamp means the nearest of them, of two as
/// near the earlier. Throws Error with file and line where a row is refused, names no image, or
/// lies `max_offset_s` or more from every stamp.
[[nodiscard]] std::vector<ScoreOfValue> read_scores(
    const std::filesystem::path& file, const std::vector<std::filesystem::path>& images,
    const std::vector<double>& stamps_s, double max_offset_s);

}  // namespace mapscore::eval
