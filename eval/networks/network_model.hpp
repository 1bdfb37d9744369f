// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// In which order a network takes the colours of a pixel.
enum class ChannelOrder { rgb, bgr };
constexpr auto names_of(ChannelOrder) {
  return std::to_array<std::string_view>({"rgb", "bgr"});
}

/// What a network's output holds for each class of a pixel.
enum class NetworkOutput { logits, probabilities };
constexpr auto names_of(NetworkOutput) {
  return std::to_array<std::string_view>({"logits", "probabilities"});
}

/// A segmentation network in an ONNX file, and how it wants its input: colour x of 0..255 enters as
/// (scale x - mean) / std of its channel, depth in metres as (depth - mean) / std.
struct NetworkModel {
  std::filesystem::path model, classes;
  ChannelOrder channels = ChannelOrder::rgb;
  double scale = 1;
  std::vector<double> mean = {}, std = {};  ///< by channel of the input; empty: 0 and 1
  NetworkOutput output = NetworkOutput::logits;

  bool operator==(const NetworkModel&) const = default;
};

/// Hashes of the files of a network, by what they are. Throws Error where one is missing.
[[nodiscard]] std::string content_of(const NetworkModel& network);

/// The settings of a network without its files, in one line.
[[nodiscard]] std::string settings_text(const NetworkModel& network);

}  // namespace mapscore::eval
