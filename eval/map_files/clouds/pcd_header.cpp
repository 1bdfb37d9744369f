// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/pcd_header.hpp"

#include "eval/map_files/refusal.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace mapscore::eval {
namespace {

constexpr std::size_t kMostFields = 1024;

/// The words of one line of the header, without its key.
struct Entry {
  std::size_t line = 0;
  std::vector<std::string> words;
};

std::optional<ScalarType> scalar_type_of(std::string_view type, std::size_t size) {
  struct Row {
    std::string_view type;
    std::size_t size;
    ScalarType scalar;
  };
  for (const Row& row : {Row{"I", 1, ScalarType::int8}, Row{"I", 2, ScalarType::int16},
                         Row{"I", 4, ScalarType::int32}, Row{"I", 8, ScalarType::int64},
                         Row{"U", 1, ScalarType::uint8}, Row{"U", 2, ScalarType::uint16},
                         Row{"U", 4, ScalarType::uint32}, Row{"U", 8, ScalarType::uint64},
                         Row{"F", 4, ScalarType::float32}, Row{"F", 8, ScalarType::float64}})
    if (row.type == type && row.size == size) return row.scalar;
  return std::nullopt;
}

class HeaderParser {
 public:
  explicit HeaderParser(const std::filesystem::path& file) : file_(file) {}

  PcdHeader parse(std::string_view bytes) {
    PcdHeader header;
    TextLines lines(bytes);
    for (std::vector<std::string_view> words; !entries_.contains("DATA");) {
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
  void take(const std::vector<std::string_view>& words, std::size_t line) {
    if (words[0].starts_with('#')) return;
    std::string key(words[0] == "COLUMNS" ? "FIELDS" : words[0]);
    bool known = false;
    for (const char* name : {"VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT",
                             "VIEWPOINT", "POINTS", "DATA"})
      known = known || key == name;
    if (!known) refuse(file_, line, fmt::format("unknown word {} in the header", shown(key)));
    if (words.size() > kMostFields + 1)
      refuse(file_, line,
             fmt::format("{} has more than {} values; leave out fields of the points", key,
                         kMostFields));
    Entry entry{line, {}};
    for (std::size_t word = 1; word < words.size(); ++word) entry.words.emplace_back(words[word]);
    if (!entries_.emplace(key, std::move(entry)).second)
      refuse(file_, line, fmt::format("{} stands twice in the header", key));
  }

  [[nodiscard]] const Entry* find(const std::string& key) const {
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Entry& need(const std::string& key) const {
    const Entry* entry = find(key);
    if (entry == nullptr) refuse(file_, fmt::format("the header has no line {}", key));
    return *entry;
  }
  /// A line with one word for each field.
  [[nodiscard]] const Entry& need_each(const std::string& key, std::size_t fields) const {
    const Entry& entry = need(key);
    if (entry.words.size() != fields)
      refuse(file_, entry.line,
             fmt::format("{} has {} values for {} fields", key, entry.words.size(), fields));
    return entry;
  }
  [[nodiscard]] std::size_t whole(const Entry& entry, std::size_t word) const {
    const auto number = word < entry.words.size() ? parse_count(entry.words[word]) : std::nullopt;
    if (!number) refuse(file_, entry.line, "expected a whole number");
    return *number;
  }
  [[nodiscard]] std::optional<std::size_t> single(const std::string& key) const {
    const Entry* entry = find(key);
    if (entry == nullptr) return std::nullopt;
    if (entry->words.size() != 1)
      refuse(file_, entry->line, fmt::format("{} needs one value", key));
    return whole(*entry, 0);
  }

  [[nodiscard]] std::vector<PcdField> fields() const {
    const Entry& names = need("FIELDS");
    const std::size_t count = names.words.size();
    const Entry& sizes = need_each("SIZE", count);
    const Entry& types = need_each("TYPE", count);
    const Entry* counts = find("COUNT") ? &need_each("COUNT", count) : nullptr;
    std::vector<PcdField> fields;
    std::size_t numbers = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const auto type = scalar_type_of(types.words[n], whole(sizes, n));
      if (!type)
        refuse(file_, types.line,
               fmt::format("field {}: there is no type {} of size {}", shown(names.words[n]),
                           shown(types.words[n]), whole(sizes, n)));
      const std::size_t each = counts ? whole(*counts, n) : 1;
      if (each == 0 || each > kMostWords || (numbers += each) > kMostWords)
        refuse(file_, counts ? counts->line : names.line,
               "COUNT is 0, or in all beyond 1048576; mend the header");
      fields.push_back({{names.words[n], *type, each == 1}, each});
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
             fmt::format("WIDTH {} times HEIGHT {} is not POINTS {}", columns, rows, all));
    return all;
  }

  [[nodiscard]] PcdData data() const {
    const Entry& entry = need("DATA");
    const std::string kind = entry.words.size() == 1 ? entry.words[0] : "";
    if (kind == "ascii") return PcdData::ascii;
    if (kind == "binary") return PcdData::binary;
    if (kind == "binary_compressed") return PcdData::binary_compressed;
    refuse(file_, entry.line, "DATA is none of ascii, binary, binary_compressed");
  }

  const std::filesystem::path& file_;
  std::map<std::string, Entry> entries_;
};

}  // namespace

PcdHeader parse_pcd_header(std::string_view bytes, const std::filesystem::path& file) {
  return HeaderParser(file).parse(bytes);
}

}  // namespace mapscore::eval
