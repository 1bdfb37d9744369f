// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "eval/objects/object_score.hpp"
#include "eval/report/table.hpp"

#include <vector>

namespace mapscore::eval {

/// Scores of an object map: a row for each detected class that has an object in the truth or the
/// map, and one for all. `counts`: by class id.
[[nodiscard]] Table object_table(const std::vector<ObjectCounts>& counts, const ClassTable& table);

}  // namespace mapscore::eval
