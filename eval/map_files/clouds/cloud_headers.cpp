// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_headers.hpp"

#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace mapscore::eval {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t kMostFields = 1024;
/// By the numbers of PcdData.
constexpr std::string_view kKinds[] = {"ascii", "binary", "binary_compressed"};
constexpr std::string_view kKeys[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                      "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// The words of one line of the header, without its key.
struct Entry {
  std::size_t line = 0;
  std::vector<std::string> words;
};

std::optional<ScalarType> scalar_type_of(std::string_view type, std::size_t size) {
  constexpr std::pair<std::string_view, ScalarType> kTypes[] = {
      {"I", kScalar<std::int8_t>},   {"I", kScalar<std::int16_t>},  {"I", kScalar<std::int32_t>},
      {"I", kScalar<std::int64_t>},  {"U", kScalar<std::uint8_t>},  {"U", kScalar<std::uint16_t>},
      {"U", kScalar<std::uint32_t>}, {"U", kScalar<std::uint64_t>}, {"F", kScalar<float>},
      {"F", kScalar<double>}};
  for (const auto& [letter, scalar] : kTypes)
    if (letter == type && scalar.size == size) return scalar;
  return std::nullopt;
}

class PcdHeaderParser {
 public:
  explicit PcdHeaderParser(const std::filesystem::path& file) : file_(file) {}

  PcdHeader parse(std::string_view bytes) {
    PcdHeader header;
    TextLines lines(bytes);
    for (Words words; !entries_.contains("DATA");) {
      if (!lines.next_words(words))
        refuse(file_, "no PCD file, or truncated: its header has no line DATA");
      take(words, lines.number());
    }
    header.bytes = lines.taken();
    header.lines = lines.number();
    header.fields = fields();
    header.points = points();
    header.data = data();
    return header;
  }

 private:
  void take(const Words& words, std::size_t line) {
    if (words[0].starts_with('#')) return;
    const std::string key(words[0] == "COLUMNS" ? "FIELDS" : words[0]);
    if (std::ranges::find(kKeys, key) == std::end(kKeys))
      refuse(file_, line, "unknown word {} in the header", excerpt(key));
    if (words.size() > kMostFields + 1)
      refuse(file_, line, "{} has more than {} values; leave out fields of the points", key,
             kMostFields);
    if (!entries_.try_emplace(key, Entry{line, {words.begin() + 1, words.end()}}).second)
      refuse(file_, line, "{} stands twice in the header", key);
  }

  [[nodiscard]] const Entry* find(const std::string& key) const {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Entry& need(const std::string& key) const {
    const Entry* entry = find(key);
    if (entry == nullptr) refuse(file_, "the header has no line {}", key);
    return *entry;
  }
  /// A line with one word for each field.
  [[nodiscard]] const Entry& need_each(const std::string& key, std::size_t fields) const {
    const Entry& entry = need(key);
    if (entry.words.size() != fields)
      refuse(file_, entry.line, "{} has {} values for {} fields", key, entry.words.size(), fields);
    return entry;
  }
  [[nodiscard]] std::size_t whole(const Entry& entry, std::size_t word) const {
    const auto number = parse_count(entry.words[word]);
    if (!number) refuse(file_, entry.line, "expected a whole number");
    return *number;
  }
  [[nodiscard]] std::optional<std::size_t> single(const std::string& key) const {
    const Entry* entry = find(key);
    if (entry == nullptr) return std::nullopt;
    if (entry->words.size() != 1) refuse(file_, entry->line, "{} needs one value", key);
    return whole(*entry, 0);
  }

  [[nodiscard]] std::vector<CloudField> fields() const {
    const Entry& names = need("FIELDS");
    const std::size_t count = names.words.size();
    const Entry& sizes = need_each("SIZE", count);
    const Entry& types = need_each("TYPE", count);
    const Entry* counts = find("COUNT") ? &need_each("COUNT", count) : nullptr;
    std::vector<CloudField> fields;
    std::size_t numbers = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t size = whole(sizes, n);
      const auto type = scalar_type_of(types.words[n], size);
      if (!type)
        refuse(file_, types.line, "field {}: there is no type {} of size {}",
               excerpt(names.words[n]), excerpt(types.words[n]), size);
      const std::size_t each = counts ? whole(*counts, n) : 1;
      if (each == 0 || each > kMostWords || (numbers += each) > kMostWords)
        refuse(file_, counts ? counts->line : names.line,
               "COUNT is 0, or in all beyond 1048576; mend the header");
      fields.push_back({names.words[n], *type, each});
    }
    return fields;
  }

  [[nodiscard]] std::size_t points() const {
    const auto width = single("WIDTH"), height = single("HEIGHT"), points = single("POINTS");
    if (!points && !(width && height))
      refuse(file_, "the header has neither POINTS nor WIDTH and HEIGHT");
    const std::size_t rows = height.value_or(1);
    const std::size_t columns = width.value_or(points.value_or(0));
    const std::size_t all = points ? *points : columns * rows;
    const bool fits =
        rows == 0 || columns == 0 ? all == 0 : all % rows == 0 && all / rows == columns;
    if (!fits)
      refuse(file_, need(points ? "POINTS" : "WIDTH").line,
             "WIDTH {} times HEIGHT {} is not POINTS {}", columns, rows, all);
    return all;
  }

  [[nodiscard]] PcdData data() const {
    const Entry& entry = need("DATA");
    const std::string word = entry.words.size() == 1 ? entry.words[0] : "";
    const auto kind = std::ranges::find(kKinds, word);
    if (kind == std::end(kKinds))
      refuse(file_, entry.line, "DATA is none of {}", fmt::join(kKinds, ", "));
    return static_cast<PcdData>(kind - std::begin(kKinds));
  }

  const std::filesystem::path& file_;
  std::map<std::string, Entry> entries_;
};

/// By the numbers of PlyFormat.
constexpr std::string_view kFormats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// Elements and properties of a file together. Each takes some thirty times its bytes.
constexpr std::size_t kMostEntries = 1024;

struct TypeNames {
  std::string_view name, other_name;
  ScalarType type;
};
constexpr TypeNames kTypes[] = {
    {"char", "int8", kScalar<std::int8_t>},    {"uchar", "uint8", kScalar<std::uint8_t>},
    {"short", "int16", kScalar<std::int16_t>}, {"ushort", "uint16", kScalar<std::uint16_t>},
    {"int", "int32", kScalar<std::int32_t>},   {"uint", "uint32", kScalar<std::uint32_t>},
    {"float", "float32", kScalar<float>},      {"double", "float64", kScalar<double>},
};

class PlyHeaderParser {
 public:
  PlyHeaderParser(std::string_view bytes, const std::filesystem::path& file)
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
        refuse_line("unknown word {} in the header", excerpt(words[0]));
      }
    }
    if (!ended) refuse(file_, "the header does not end; is the file truncated?");
    if (!has_format) refuse(file_, "the header has no line 'format'");
    header_.bytes = lines_.taken();
    header_.lines = lines_.number();
    return std::move(header_);
  }

 private:
  template <class... Args>
  [[noreturn]] void refuse_line(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, lines_.number(), what, std::forward<Args>(args)...);
  }

  void count_entry() {
    if (++entries_ > kMostEntries)
      refuse_line("more than {} elements and properties; leave out what is no part of the map",
                  kMostEntries);
  }

  void take_format(const Words& words) {
    if (words.size() != 3 || words[2] != "1.0")
      refuse_line("expected 'format NAME 1.0'; other versions are not read");
    const auto format = std::ranges::find(kFormats, words[1]);
    if (format == std::end(kFormats))
      refuse_line("format {} is none of {}", excerpt(words[1]), fmt::join(kFormats, ", "));
    header_.format = static_cast<PlyFormat>(format - std::begin(kFormats));
  }

  void take_element(const Words& words) {
    const auto count = words.size() == 3 ? parse_count(words[2]) : std::nullopt;
    if (!count) refuse_line("expected 'element NAME COUNT'");
    for (const PlyElement& element : header_.elements)
      if (element.name == words[1]) refuse_line("element {} stands twice", excerpt(words[1]));
    header_.elements.push_back({std::string(words[1]), *count, {}});
  }

  void take_property(const Words& words) {
    if (header_.elements.empty()) refuse_line("a property before the first element");
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
      refuse_line("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    CloudField property{std::string(words.back()), type_at(words[words.size() - 2])};
    if (is_list) {
      property.length_type = type_at(words[2]);
      if (property.length_type->is_real) refuse_line("a list's length is no whole number");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[nodiscard]] ScalarType type_at(std::string_view word) const {
    for (const TypeNames& names : kTypes)
      if (word == names.name || word == names.other_name) return names.type;
    refuse_line("type {} is none of PLY's", excerpt(word));
  }

  TextLines lines_;
  const std::filesystem::path& file_;
  PlyHeader header_;
  std::size_t entries_ = 0;
};

}  // namespace

PcdHeader parse_pcd_header(std::string_view bytes, const std::filesystem::path& file) {
  return PcdHeaderParser(file).parse(bytes);
}

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file) {
  return PlyHeaderParser(bytes, file).parse();
}

}  // namespace mapscore::eval
