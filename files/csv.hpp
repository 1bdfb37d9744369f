// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapscore {

/// A cell as RFC 4180 writes it: between quotes where it holds a comma, a quote, an end of line or
/// a blank at an end. A text that a spreadsheet would run, since it begins with = + - @, gets an
/// apostrophe before it, as spreadsheets mark texts; so does one that begins with an apostrophe.
/// Numbers and a lone `-` stay.
[[nodiscard]] std::string csv_cell(std::string_view text);

/// Cells with commas between and an end of line.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& cells);

/// Takes a line apart, quotes and the apostrophe of csv_cell removed, blanks around a cell without
/// quotes too. Nothing when a quote does not end or something follows it. Of a line with more than
/// `most` cells, `most` + 1 are given, so that a line of commas does not take hundreds of times its
/// length.
[[nodiscard]] std::optional<std::vector<std::string>> csv_cells(std::string_view line,
                                                                std::size_t most);

}  // namespace mapscore
