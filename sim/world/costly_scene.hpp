// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>

namespace mapscore::sim {

/// Whether MuJoCo can need far more memory or time for an MJCF file than its text and the files it
/// names weigh: it holds elements that multiply (replicate, height fields, flexes, includes, sizes;
/// all that are not known to be harmless), textures or meshes of half a gigabyte in all, or text
/// that is no plain XML. False for a file that is missing. Throws Error where a named file is a
/// pipe or a device. Costs a fraction of a millisecond.
[[nodiscard]] bool may_cost_much(const std::filesystem::path& file);

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
