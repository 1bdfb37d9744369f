// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/network_model.hpp"

#include "files/file_bytes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mapscore::eval {

std::string content_of(const NetworkModel& network) {
  return fmt::format("{} model\n{} classes\n", hash_of(read_file(network.model)),
                     hash_of(read_file(network.classes)));
}

std::string settings_text(const NetworkModel& network) {
  return fmt::format("channels {}, scale {}, mean [{}], std [{}], output {}",
                     names_of(network.channels)[static_cast<std::size_t>(network.channels)],
                     network.scale, fmt::join(network.mean, ", "), fmt::join(network.std, ", "),
                     names_of(network.output)[static_cast<std::size_t>(network.output)]);
}

}  // namespace mapscore::eval
