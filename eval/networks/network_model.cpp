// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/network_model.hpp"

#include "core/parameters.hpp"
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
                     word_of(network.channels), network.scale, fmt::join(network.mean, ", "),
                     fmt::join(network.std, ", "), word_of(network.output));
}

}  // namespace mapscore::eval
