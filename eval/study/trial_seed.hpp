// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/random_stream.hpp"

#include <cstdint>

namespace mapscore::eval {

/// The seed of everything that one repetition of a study draws; shared by all methods and doses.
[[nodiscard]] inline std::uint64_t trial_seed(std::uint64_t study_seed, int seed_index) {
  return RandomStream(study_seed, "trial", {static_cast<std::uint64_t>(seed_index)}).bits();
}

}  // namespace mapscore::eval
