// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/study.hpp"
#include "sim/faults/depth_dose.hpp"
#include "sim/faults/label_dose.hpp"

namespace mapscore::eval {

// The preset with the keys that are given in its place, and every dose times `scale`. A confusion
// matrix is scaled off its diagonal, which takes the rest of 1, and takes the place of the preset's
// confusion.

[[nodiscard]] sim::DepthDose dose_of(const DepthFaultSettings& settings);
[[nodiscard]] sim::LabelDose dose_of(const LabelFaultSettings& settings);

// Settings of the same doses without preset and scale: only what differs from the ideal, and
// nothing when every dose is zero. Equal doses give equal settings.

[[nodiscard]] DepthFaultSettings resolved(const DepthFaultSettings& settings);
[[nodiscard]] LabelFaultSettings resolved(const LabelFaultSettings& settings);

}  // namespace mapscore::eval
