// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/store.hpp"

#include <string>

namespace mapscore::eval {

/// A trial's result as one line of JSON: raw counts only, exact, same result same bytes.
[[nodiscard]] std::string to_json(const TrialResult& result);
/// Throws Error when the text is not what to_json writes.
[[nodiscard]] TrialResult result_from_json(const std::string& text);

}  // namespace mapscore::eval
