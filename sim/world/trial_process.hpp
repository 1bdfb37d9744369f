// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>

namespace mapscore::sim {

/// What a trial may take.
struct TrialLimits {
  unsigned long memory_gb = 2;  ///< beyond what this process has
  unsigned processor_s = 60;    ///< and twice that by the clock
};

/// Runs `work` in a child process within `limits`, to find out whether it would crash this one or
/// fill the memory; its results are lost. Throws Error naming `scene` when the child died or needed
/// more, and with the message of whatever `work` threw.
void try_apart(const std::filesystem::path& scene, const std::function<void()>& work,
               const TrialLimits& limits = {});

}  // namespace mapscore::sim
