// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

namespace mapscore::eval {

/// Throws through `blame` when doses contradict each other, or a covariance is none.
void check_faults(const FaultSettings& faults, const Blame& blame);

}  // namespace mapscore::eval
