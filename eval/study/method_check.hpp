// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

namespace mapscore::eval {

/// Throws through `blame` when there is no method, or a command could not be followed as it is
/// written; whether its program is there is looked at where it is run.
void check_methods(const Study& study, const Blame& blame);

}  // namespace mapscore::eval
