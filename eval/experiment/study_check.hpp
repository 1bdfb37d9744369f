// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/experiment/study.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// Throws Error that the value at a dotted path is wrong in the way of `problem`; knows where it
/// was written.
using Blame = std::function<void(std::string_view path, const std::string& problem)>;

/// What must hold between leaves, for the study and each cell of its sweep. Throws through `blame`.
void check(const Study& study, const Blame& blame);

}  // namespace mapscore::eval
