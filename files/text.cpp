// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace mapscore {
namespace {

constexpr std::size_t kLongestName = 255;                  ///< bytes, as of a file's name
constexpr std::string_view kReplacement = "\xef\xbf\xbd";  ///< U+FFFD, for what is no character

/// Bytes that a character takes, told by its first one; 0 where none begins so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// One character of UTF-8, or one byte that belongs to none.
struct Character {
  std::string_view bytes;
  char32_t code = 0;
  bool valid = false;
};

Character first_of(std::string_view text) {
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};  // by length
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = length_of(byte(0));
  const Character broken{text.substr(0, 1), byte(0), false};
  if (length == 0 || length > text.size()) return broken;
  char32_t code = length == 1 ? byte(0) : byte(0) & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80) return broken;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[length] || surrogate || code > 0x10ffff) return broken;
  return {text.substr(0, length), code, true};
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

/// Characters that show nothing and change what others show: separators of lines, marks of
/// direction, tags. The joiners of scripts and emoji (200C, 200D) are none of them.
bool is_invisible(char32_t code) {
  constexpr std::pair<char32_t, char32_t> kRanges[] = {
      {0xad, 0xad},     {0x61c, 0x61c},   {0x200b, 0x200b}, {0x200e, 0x200f},  {0x2028, 0x202e},
      {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
  return std::ranges::any_of(
      kRanges, [code](const auto& range) { return code >= range.first && code <= range.second; });
}

std::string escaped(const Character& c) {
  if (c.code == '\n') return "\\n";
  if (c.code == '\r') return "\\r";
  if (c.code == '\t') return "\\t";
  const auto code = static_cast<std::uint32_t>(c.code);
  if (!c.valid || code < 0x100) return fmt::format("\\x{:02x}", code);
  return code < 0x10000 ? fmt::format("\\u{:04x}", code) : fmt::format("\\U{:08x}", code);
}

/// The text with each of its characters as `written` writes it.
std::string rewritten(std::string_view text, auto written) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_of(text);
    result += written(c);
    text.remove_prefix(c.bytes.size());
  }
  return result;
}

/// Every character that `keep` refuses escaped.
std::string with_escapes(std::string_view text, bool (*keep)(char32_t)) {
  return rewritten(text, [&](const Character& c) {
    return c.valid && keep(c.code) ? std::string(c.bytes) : escaped(c);
  });
}

bool is_plain(char32_t code) {
  return !is_control(code) && !is_invisible(code);
}

bool keeps_lines(char32_t code) {
  return code == '\n' || code == '\t' || is_plain(code);
}

}  // namespace

std::optional<std::string> unfit_as_name(std::string_view text) {
  if (text.empty()) return "is empty; write a name";
  if (text.size() > kLongestName)
    return fmt::format("is {} bytes long; a name has at most {}", text.size(), kLongestName);
  for (std::string_view rest = text; !rest.empty();) {
    const Character c = first_of(rest);
    if (!c.valid) return fmt::format("'{}' is not UTF-8; write it anew", shown(text));
    if (!is_plain(c.code))
      return fmt::format("'{}' holds the {} character {}; remove it", shown(text),
                         is_control(c.code) ? "control" : "invisible", escaped(c));
    rest.remove_prefix(c.bytes.size());
  }
  return std::nullopt;
}

std::string shown(std::string_view text) {
  return with_escapes(text, is_plain);
}

std::string shown_lines(std::string_view text) {
  return with_escapes(text, keeps_lines);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string printable(text.substr(0, kLongest));
  std::ranges::replace_if(
      printable, [](unsigned char code) { return code < 0x20 || code == 0x7f; }, '?');
  return fmt::format("'{}{}'", printable, text.size() > kLongest ? "..." : "");
}

std::string with_signs(std::string_view text, const std::function<bool(char32_t)>& keep,
                       std::string_view sign) {
  return rewritten(text, [&](const Character& c) {
    return std::string(c.valid && keep(c.code) ? c.bytes : sign);
  });
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return lower;
}

std::string yaml_quoted(std::string_view text) {
  const auto written = [](const Character& c) {
    if (!c.valid) return std::string(kReplacement);
    if (c.code == '\n') return std::string("\\n");
    if (is_control(c.code)) return fmt::format("\\x{:02x}", static_cast<std::uint32_t>(c.code));
    return (c.code == '"' || c.code == '\\' ? "\\" : "") + std::string(c.bytes);
  };
  return '"' + rewritten(text, written) + '"';
}

std::string xml_quoted(std::string_view text) {
  const auto written = [](const Character& c) -> std::string_view {
    if (c.code == '&') return "&amp;";
    if (c.code == '<') return "&lt;";
    if (c.code == '>') return "&gt;";
    if (c.code == '"') return "&quot;";
    const bool unfit = !c.valid || is_control(c.code) || c.code == 0xfffe || c.code == 0xffff;
    return unfit ? "_" : c.bytes;
  };
  return '"' + rewritten(text, written) + '"';
}

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char letter : shown_lines(text)) {
    if (letter == '\n')
      quoted += "'.\"\\n\".'";
    else if (letter == '\'')
      quoted += "'.\"'\".'";  // gnuplot 5.4 loses count of '' at the start of a string
    else
      quoted += letter;
  }
  return quoted + '\'';
}

std::string gnuplot_column(std::string_view text) {
  std::string column = shown(text);
  std::ranges::replace(column, '"', '\'');
  return '"' + column + '"';
}

bool is_word(std::string_view text, std::string_view marks) {
  const auto fits = [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           marks.find(c) != marks.npos;
  };
  return !text.empty() && std::ranges::all_of(text, fits);
}

std::string shell_word(std::string_view text) {
  if (is_word(text, "_-./,:+=@%")) return std::string(text);
  std::string word = "'";
  for (const char letter : text)
    word += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return word + '\'';
}

std::size_t unfinished_tail(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xc0u) == 0x80) continue;
    return length_of(byte) > back ? back : 0;
  }
  return 0;
}

}  // namespace mapscore
