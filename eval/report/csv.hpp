// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

namespace mapscore::eval {

/// One line of CSV (RFC 4180) with its line end; cells with commas, quotes or line breaks are
/// quoted.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);

/// The cells of one line, quotes taken off.
[[nodiscard]] std::vector<std::string> csv_cells(const std::string& line);

}  // namespace mapscore::eval
