// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/study/study.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace mapscore::eval {

/// Throws an Error that states where the value at a dotted path was written, and `problem`.
using Blame = std::function<void(std::string_view path, const std::string& problem)>;

/// What must hold between leaves, for the study and each cell of its sweep. Throws through `blame`.
void check(const Study& study, const Blame& blame);

}  // namespace mapscore::eval
