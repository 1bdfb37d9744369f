// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/study_store.hpp"
#include "eval/score/counts.hpp"

#include <string>

namespace mapscore::eval {

/// The counts of a scene's trial in the order of the record's classes; those that the scene does
/// not have are zero.
[[nodiscard]] Counts in_table(const StudyRecord& record, const std::string& scene, Counts counts);

}  // namespace mapscore::eval
