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

/// Does `work` in a process of its own, within `limits`, so that its end does no harm; nothing else
/// comes of it. Throws Error naming `scene` when the process died or needed more, and whatever
/// Error `work` threw.
void try_apart(const std::filesystem::path& scene, const std::function<void()>& work,
               const TrialLimits& limits = {});

}  // namespace mapscore::sim
