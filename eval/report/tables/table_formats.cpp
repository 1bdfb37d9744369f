// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/table_formats.hpp"

#include "files/csv.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::string_view kColumnGap = "  ", kCaptionMark = "# ";

std::optional<double> finite_number(const std::string& cell) {
  const auto number = parse_real(cell);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string json_string(const std::string& text) {
  return nlohmann::json(shown(text)).dump();
}

/// A whole number or a number as such, `-` and nothing as null, anything else as text. Numbers have
/// their fewest digits, which nlohmann's do not: 0.457180744, not 0.45718074399999997.
std::string json_of(const std::string& cell) {
  if (cell == "-" || cell.empty()) return "null";
  if (const auto whole = parse_whole(cell)) return fmt::format("{}", *whole);
  if (const auto number = finite_number(cell)) return fmt::format("{}", *number);
  return json_string(cell);
}

/// A list or an object, an item a line; `indent` is that of its end.
std::string json_lines(char open, const std::vector<std::string>& items, char close,
                       const std::string& indent) {
  if (items.empty()) return {open, close};
  const std::string start = '\n' + indent + "  ";
  return fmt::format("{}{}{}\n{}{}", open, start, fmt::join(items, ',' + start), indent, close);
}

std::string json_of(const Table& table, const std::string& indent) {
  std::vector<std::string> caption, rows;
  for (const std::string& line : table.caption) caption.push_back(json_string(line));
  for (const auto& row : table.rows) {
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < row.size(); ++i)
      entries.push_back(json_string(table.columns[i]) + ": " + json_of(row[i]));
    rows.push_back(json_lines('{', entries, '}', indent + "    "));
  }
  return json_lines('{',
                    {"\"caption\": " + json_lines('[', caption, ']', indent + "  "),
                     "\"rows\": " + json_lines('[', rows, ']', indent + "  ")},
                    '}', indent);
}

/// Characters of UTF-8, which all continue but for their first byte.
std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (byte & 0xC0) != 0x80; }));
}

/// Letters of each column.
std::vector<std::size_t> widths_of(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(letters_of(shown(column)));
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], letters_of(shown(row[i])));
  return widths;
}

/// Which columns stand side by side: the keys, and then as many of the others as fit.
std::vector<std::vector<std::size_t>> parts_of(const std::vector<std::size_t>& widths,
                                               std::size_t keys, std::size_t width) {
  std::vector<std::size_t> key_columns;
  std::size_t key_width = 0;
  for (std::size_t i = 0; i < std::min(keys, widths.size()); ++i) {
    key_columns.push_back(i);
    key_width += widths[i] + kColumnGap.size();
  }
  std::vector<std::vector<std::size_t>> parts{key_columns};
  std::size_t used = key_width;
  for (std::size_t i = key_columns.size(); i < widths.size(); ++i) {
    const bool first = parts.back().size() == key_columns.size();
    if (width > 0 && !first && used + widths[i] > width) {
      parts.push_back(key_columns);
      used = key_width;
    }
    parts.back().push_back(i);
    used += widths[i] + kColumnGap.size();
  }
  return parts;
}

/// A line of the caption, broken between words where it is longer than `width`.
std::string caption_text(const std::string& caption, std::size_t width) {
  if (width == 0 || kCaptionMark.size() + caption.size() <= width)
    return fmt::format("{}{}\n", kCaptionMark, caption);
  std::string text, line(kCaptionMark);
  std::istringstream words(caption);
  for (std::string word; words >> word;) {
    if (line.size() > kCaptionMark.size() + 2 && line.size() + word.size() > width) {
      text += line.substr(0, line.size() - 1) + '\n';
      line = fmt::format("{}  ", kCaptionMark);
    }
    line += word + ' ';
  }
  return text + line.substr(0, line.size() - 1) + '\n';
}

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) {
    text += ' ';
    for (const char letter : shown(cell))
      text += std::string_view("\\|*_`<>[]").find(letter) == std::string_view::npos
                  ? std::string(1, letter)
                  : std::string{'\\', letter};
    text += " |";
  }
  return text + '\n';
}

/// What plain LaTeX does not take as it stands.
constexpr auto kTexWords = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"\\", "\\textbackslash{}"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"&", "\\&"},
    {"%", "\\%"},
    {"$", "\\$"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"σ", "$\\sigma$"},
    {"×", "$\\times$"},
});

std::string tex_text(const std::string& cell) {
  const std::string plain = shown(cell);
  std::string text;
  for (std::string_view rest = plain; !rest.empty();) {
    const auto word = std::ranges::find_if(
        kTexWords, [&](const auto& entry) { return rest.starts_with(entry.first); });
    if (word == kTexWords.end()) {
      text += rest.front();
      rest.remove_prefix(1);
    } else {
      text += word->second;
      rest.remove_prefix(word->first.size());
    }
  }
  return text;
}

/// Numbers with a minus instead of a hyphen.
std::string tex_cell(const std::string& cell) {
  if (cell == "-") return "--";
  return cell.starts_with('-') && finite_number(cell) ? "$-$" + tex_text(cell.substr(1))
                                                      : tex_text(cell);
}

std::string tex_line(const std::vector<std::string>& cells,
                     std::string (*text_of)(const std::string&)) {
  std::string text;
  for (std::size_t n = 0; n < cells.size(); ++n) text += (n > 0 ? " & " : "") + text_of(cells[n]);
  return text + " \\\\\n";
}

/// Of tabular: numbers at the right.
std::string tex_columns(const Table& table) {
  std::string columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto is_number = [i](const auto& row) { return finite_number(row[i]).has_value(); };
    const auto is_undefined = [i](const auto& row) { return row[i] == "-"; };
    const bool numbers = std::ranges::any_of(table.rows, is_number) &&
                         std::ranges::all_of(table.rows, [&](const auto& row) {
                           return is_number(row) || is_undefined(row);
                         });
    columns += numbers ? 'r' : 'l';
  }
  return columns;
}

}  // namespace

std::string to_text(const Table& table, std::size_t width) {
  const std::vector<std::size_t> widths = widths_of(table);
  std::string text;
  for (const std::string& caption : table.caption) text += caption_text(shown(caption), width);
  const auto parts = parts_of(widths, table.keys, width);
  for (const auto& part : parts) {
    const auto line = [&](const std::vector<std::string>& cells) {
      std::string letters;
      for (const std::size_t i : part) {
        const std::string cell = shown(cells[i]);
        letters += cell + std::string(widths[i] - letters_of(cell), ' ') + std::string(kColumnGap);
      }
      return letters.substr(0, letters.find_last_not_of(' ') + 1) + '\n';
    };
    text += (&part == &parts.front() ? "" : "\n") + line(table.columns);
    for (const auto& row : table.rows) text += line(row);
  }
  return text;
}

std::string to_text(const Table& table) {
  return to_text(table, 0);
}

std::string to_csv(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string to_json(const Table& table) {
  return json_of(table, "") + '\n';
}

std::string to_json(const std::vector<Table>& tables) {
  std::vector<std::string> items;
  for (const Table& table : tables) items.push_back(json_of(table, "  "));
  return json_lines('[', items, ']', "") + '\n';
}

std::string to_markdown(const Table& table) {
  std::string text;
  for (const std::string& caption : table.caption) text += shown(caption) + "  \n";
  if (!text.empty()) text += '\n';
  text += markdown_line(table.columns) + '|';
  for (std::size_t n = 0; n < table.columns.size(); ++n) text += " --- |";
  text += '\n';
  for (const auto& row : table.rows) text += markdown_line(row);
  return text;
}

std::string to_tex(const Table& table) {
  std::string text;
  for (const std::string& caption : table.caption) text += "% " + shown(caption) + '\n';
  text += "\\begin{tabular}{" + tex_columns(table) + "}\n\\toprule\n" +
          tex_line(table.columns, tex_text) + "\\midrule\n";
  for (const auto& row : table.rows) text += tex_line(row, tex_cell);
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace mapscore::eval
