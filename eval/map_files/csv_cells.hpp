// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore::eval {

/// Cells of one line of CSV, blanks around them removed, quotes as in RFC 4180 (but a cell ends on
/// its line). Nothing when a quote is not closed or something follows it.
[[nodiscard]] std::optional<std::vector<std::string>> csv_cells(std::string_view line);

}  // namespace mapscore::eval
