// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/tables/table.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace mapscore::eval {

// Tables as texts. Names in them are made harmless for where they go; an undefined cell is `-`.

/// Columns with blanks between, the caption above.
[[nodiscard]] std::string to_text(const Table& table);
/// The same in lines of at most `width` letters, unless it is 0: the columns that do not fit follow
/// below, the keys of the rows repeated, and the caption is broken between words. The keys and one
/// column stand side by side in any case.
[[nodiscard]] std::string to_text(const Table& table, std::size_t width);
[[nodiscard]] std::string to_csv(const Table& table);
[[nodiscard]] std::string to_json(const Table& table);
/// Several tables as one list.
[[nodiscard]] std::string to_json(const std::vector<Table>& tables);
/// A table of GitHub's Markdown; the caption above it, a line each.
[[nodiscard]] std::string to_markdown(const Table& table);
/// A tabular of LaTeX with booktabs' rules, columns of numbers at the right; the caption above it
/// as comments.
[[nodiscard]] std::string to_tex(const Table& table);

}  // namespace mapscore::eval
