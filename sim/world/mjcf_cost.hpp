// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

namespace mapscore::sim {

/// Whether MuJoCo can need far more memory or time for an MJCF file than its text and the files it
/// names weigh: it holds elements that multiply (replicate, height fields, flexes, includes, sizes;
/// all that are not known to be harmless), textures or meshes of half a gigabyte in all, or text
/// that is no plain XML. False for a file that is missing. Throws Error where a named file is a
/// pipe or a device. Costs a fraction of a millisecond.
[[nodiscard]] bool may_cost_much(const std::filesystem::path& file);

}  // namespace mapscore::sim
