// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace mapscore {

// Texts of other people - names of classes, files, studies - on their way out. Each destination has
// one function here, and every text goes through it, so that no name is ever run, starts a line of
// its own or changes a terminal. Cells of CSV: files/csv.hpp. All functions are pure.

/// What keeps a text from being a name of a class, an instance, a geom or a study: it is empty,
/// longer than 255 bytes, not UTF-8, or holds a control character or an invisible one (line
/// separators, direction marks). Written to follow the name's place in a message; nothing when the
/// text is fit.
[[nodiscard]] std::optional<std::string> unfit_as_name(std::string_view text);

/// For a message, a table or a terminal: one line without anything that a terminal would obey.
/// Control and invisible characters and bytes that are no UTF-8 become `\n`, `\x1b`, `\u202e`; all
/// else stays.
[[nodiscard]] std::string shown(std::string_view text);
template <std::same_as<std::filesystem::path> Path>
[[nodiscard]] std::string shown(const Path& path) {
  return shown(std::string_view(path.native()));
}
/// The same for text of several lines: ends of lines and tabs stay.
[[nodiscard]] std::string shown_lines(std::string_view text);

/// A text of a file for a message: in single quotes, cut when long, control characters as '?'.
[[nodiscard]] std::string excerpt(std::string_view text);

/// The text with `sign` in the place of every character that `keep` refuses, and of every byte that
/// is no UTF-8.
[[nodiscard]] std::string with_signs(std::string_view text,
                                     const std::function<bool(char32_t)>& keep,
                                     std::string_view sign);

/// ASCII capitals made small, as names of fields, columns and endings are compared.
[[nodiscard]] std::string lower_case(std::string_view text);

/// A YAML scalar between double quotes. Bytes that are no UTF-8, which YAML cannot hold, become
/// U+FFFD.
[[nodiscard]] std::string yaml_quoted(std::string_view text);

/// The value of an XML attribute, with its quotes. What XML cannot hold becomes '_'.
[[nodiscard]] std::string xml_quoted(std::string_view text);

/// A string expression of a gnuplot script: between single quotes, within which gnuplot runs and
/// expands nothing, but for ends of lines and single quotes, which are joined on. Other control
/// characters are shown.
[[nodiscard]] std::string gnuplot_quoted(std::string_view text);
/// A column of a gnuplot data file; such a file cannot quote a quote, so double quotes become
/// single ones.
[[nodiscard]] std::string gnuplot_column(std::string_view text);

/// Whether a text is of ASCII letters, digits and `marks` alone, and not empty.
[[nodiscard]] bool is_word(std::string_view text, std::string_view marks);

/// A word of a command line that a person may paste into a POSIX shell: as it is where it is
/// plain, else between single quotes.
[[nodiscard]] std::string shell_word(std::string_view text);

/// Bytes of UTF-8 at the end of `text` that begin a character and do not end it; 0 to 3.
[[nodiscard]] std::size_t unfinished_tail(std::string_view text);

}  // namespace mapscore
