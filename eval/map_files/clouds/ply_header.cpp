// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/ply_header.hpp"

#include "eval/map_files/refusal.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

using Words = std::vector<std::string_view>;

/// Elements and properties of a file together. Each takes some thirty times its bytes.
constexpr std::size_t kMostEntries = 1024;

std::optional<ScalarType> scalar_type_of(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, ScalarType>, 16> kTypes{{
      {"char", ScalarType::int8},
      {"int8", ScalarType::int8},
      {"uchar", ScalarType::uint8},
      {"uint8", ScalarType::uint8},
      {"short", ScalarType::int16},
      {"int16", ScalarType::int16},
      {"ushort", ScalarType::uint16},
      {"uint16", ScalarType::uint16},
      {"int", ScalarType::int32},
      {"int32", ScalarType::int32},
      {"uint", ScalarType::uint32},
      {"uint32", ScalarType::uint32},
      {"float", ScalarType::float32},
      {"float32", ScalarType::float32},
      {"double", ScalarType::float64},
      {"float64", ScalarType::float64},
  }};
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  return std::nullopt;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::filesystem::path& file)
      : lines_(bytes), file_(file) {}

  PlyHeader parse() {
    if (lines_.next() != "ply") refuse(file_, "no PLY file: it does not begin with 'ply'");
    bool ended = false, has_format = false;
    for (Words words; !ended && lines_.next_words(words);) {
      if (words[0] == "end_header") {
        ended = true;
      } else if (words[0] == "format") {
        take_format(words);
        has_format = true;
      } else if (words[0] == "element") {
        count_entry();
        take_element(words);
      } else if (words[0] == "property") {
        count_entry();
        take_property(words);
      } else if (words[0] != "comment" && words[0] != "obj_info") {
        refuse_line(fmt::format("unknown word {} in the header", shown(words[0])));
      }
    }
    if (!ended) refuse(file_, "the header does not end; is the file truncated?");
    if (!has_format) refuse(file_, "the header has no line 'format'");
    header_.bytes = lines_.taken();
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse_line(const std::string& what) const {
    refuse(file_, lines_.number(), what);
  }

  void count_entry() {
    if (++entries_ > kMostEntries)
      refuse_line(
          fmt::format("more than {} elements and properties; leave out what is no part of "
                      "the map",
                      kMostEntries));
  }

  void take_format(const Words& words) {
    if (words.size() != 3 || words[2] != "1.0")
      refuse_line("expected 'format NAME 1.0'; other versions are not read");
    if (words[1] == "ascii")
      header_.format = PlyFormat::ascii;
    else if (words[1] == "binary_little_endian")
      header_.format = PlyFormat::binary_little_endian;
    else if (words[1] == "binary_big_endian")
      header_.format = PlyFormat::binary_big_endian;
    else
      refuse_line(fmt::format("format {} is none of ascii, binary_little_endian, binary_big_endian",
                              shown(words[1])));
  }

  void take_element(const Words& words) {
    const auto count = words.size() == 3 ? parse_count(words[2]) : std::nullopt;
    if (!count) refuse_line("expected 'element NAME COUNT'");
    for (const PlyElement& element : header_.elements)
      if (element.name == words[1])
        refuse_line(fmt::format("element {} stands twice", shown(words[1])));
    header_.elements.push_back({std::string(words[1]), *count, {}});
  }

  void take_property(const Words& words) {
    if (header_.elements.empty()) refuse_line("a property before the first element");
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
      refuse_line("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    PlyProperty property{std::string(words.back()), type_at(words[words.size() - 2])};
    if (is_list) {
      property.is_list = true;
      property.length_type = type_at(words[2]);
      if (is_real(property.length_type)) refuse_line("a list's length is no whole number");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[nodiscard]] ScalarType type_at(std::string_view word) const {
    const auto type = scalar_type_of(word);
    if (!type) refuse_line(fmt::format("type {} is none of PLY's", shown(word)));
    return *type;
  }

  TextLines lines_;
  const std::filesystem::path& file_;
  PlyHeader header_;
  std::size_t entries_ = 0;
};

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file) {
  return HeaderParser(bytes, file).parse();
}

}  // namespace mapscore::eval
