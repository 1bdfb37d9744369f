// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_builder.hpp"
#include "eval/map_files/clouds/cloud_headers.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <bit>

namespace mapscore::eval {
namespace {

/// A property on the way through an element's rows, and what it means.
struct Step {
  CloudField property;
  std::optional<Meaning> meaning;
};

/// Fewest bytes that a row can take.
std::size_t least_bytes(const PlyElement& element, bool ascii) {
  std::size_t bytes = 0;
  for (const CloudField& property : element.properties)
    bytes += ascii ? 2 : property.length_type.value_or(property.type).size;
  return bytes;
}

void refuse_more_than_fits(const PlyElement& element, bool ascii, std::size_t left,
                           const std::filesystem::path& file) {
  const std::size_t least = least_bytes(element, ascii);
  const std::size_t room = least == 0 ? element.count : (left + (ascii ? 1 : 0)) / least;
  if (element.count > room)
    refuse(file,
           "truncated: the header announces {} of element {}, the file has room for {} at most",
           element.count, excerpt(element.name), room);
}

class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::size_t from, bool swapped,
             const std::filesystem::path& file)
      : bytes_(bytes), from_(from), swapped_(swapped), file_(file) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size() - from_; }

  void row(const std::vector<Step>& steps, PointNumbers& numbers) {
    for (const Step& step : steps) {
      const CloudField& property = step.property;
      if (property.length_type) {
        skip_list(property);
        continue;
      }
      const char* value = take(property.type.size);
      if (step.meaning)
        at(numbers, *step.meaning) = number_at(value, *step.meaning, property.type, swapped_);
    }
  }
  [[nodiscard]] PointPlace place(std::size_t row) const { return {row + 1, false}; }

  void finish() const {
    if (left() > 0)
      refuse(file_, "{} bytes follow the last element; the header does not announce them", left());
  }

 private:
  const char* take(std::size_t size) {
    if (size > left()) refuse(file_, "truncated: it ends before its last element");
    const char* taken = bytes_.data() + from_;
    from_ += size;
    return taken;
  }

  void skip_list(const CloudField& list) {
    const double length = list.length_type->at(take(list.length_type->size), swapped_);
    if (length < 0.0) refuse(file_, "a list of {} has length {}", excerpt(list.name), length);
    take(static_cast<std::size_t>(length) * list.type.size);
  }

  std::string_view bytes_;
  std::size_t from_;
  bool swapped_;
  const std::filesystem::path& file_;
};

class AsciiBody {
 public:
  AsciiBody(std::string_view bytes, const PlyHeader& header, const std::filesystem::path& file)
      : body_(bytes.substr(header.bytes)), lines_(body_, header.lines + 1), file_(file) {}

  [[nodiscard]] std::size_t left() const { return body_.size() - lines_.taken(); }

  void row(const std::vector<Step>& steps, PointNumbers& numbers) {
    if (!lines_.next_words(words_)) refuse(file_, "truncated: it ends before its last element");
    std::size_t word = 0;
    for (const Step& step : steps) {
      if (step.property.length_type) {
        const auto length = parse_count(word_at(word++));
        if (!length || *length > words_.size() - word)
          refuse_line("the list of {} is broken", excerpt(step.property.name));
        word += *length;
      } else {
        const std::string_view text = word_at(word++);
        if (step.meaning)
          at(numbers, *step.meaning) = number(text, *step.meaning, step.property.type);
      }
    }
    if (word != words_.size())
      refuse_line("{} numbers, the header announces {}", words_.size(), word);
  }
  [[nodiscard]] PointPlace place(std::size_t /*row*/) const { return {lines_.number(), true}; }

  void finish() {
    if (lines_.next_words(words_))
      refuse_line("follows the last element; the header does not announce it");
  }

 private:
  template <class... Args>
  [[noreturn]] void refuse_line(fmt::format_string<Args...> what, Args&&... args) const {
    refuse(file_, lines_.number(), what, std::forward<Args>(args)...);
  }
  [[nodiscard]] std::string_view word_at(std::size_t word) const {
    if (word >= words_.size())
      refuse_line("only {} numbers, fewer than the header announces", words_.size());
    return words_[word];
  }
  [[nodiscard]] double number(std::string_view word, Meaning meaning, ScalarType type) const {
    const auto value = number_of(word, meaning, type);
    if (!value) refuse_line("{} is no number", excerpt(word));
    return *value;
  }

  std::string_view body_;
  TextLines lines_;
  const std::filesystem::path& file_;
  std::vector<std::string_view> words_;
};

const PlyElement& vertices_of(const PlyHeader& header, const std::filesystem::path& file) {
  const auto found = std::ranges::find(header.elements, "vertex", &PlyElement::name);
  if (found == header.elements.end()) refuse(file, "no element 'vertex', hence no points");
  return *found;
}

template <class Body>
MapFile read_body(Body& body, const PlyHeader& header, NotFinite not_finite,
                  const std::filesystem::path& file) {
  const bool ascii = header.format == PlyFormat::ascii;
  const PlyElement& vertices = vertices_of(header, file);
  const CloudMeanings meanings(vertices.properties, file);
  refuse_more_than_fits(vertices, ascii, body.left(), file);
  CloudBuilder cloud(file, meanings, not_finite, vertices.count);

  for (const PlyElement& element : header.elements) {
    const bool points = &element == &vertices;
    if (element.properties.empty()) continue;
    refuse_more_than_fits(element, ascii, body.left(), file);
    std::vector<Step> steps;
    for (const CloudField& property : element.properties)
      steps.push_back({property, points ? meanings.meaning(steps.size()) : std::nullopt});
    PointNumbers numbers{};
    for (std::size_t row = 0; row < element.count; ++row) {
      body.row(steps, numbers);
      if (points) cloud.add(numbers, body.place(row));
    }
  }
  body.finish();
  return cloud.finish();
}

}  // namespace

MapFile read_ply(const std::filesystem::path& file, NotFinite not_finite) {
  const std::string bytes = read_file(file);
  const PlyHeader header = parse_ply_header(bytes, file);
  if (header.format == PlyFormat::ascii) {
    AsciiBody body(bytes, header, file);
    return read_body(body, header, not_finite, file);
  }
  constexpr bool kLittleMachine = std::endian::native == std::endian::little;
  const bool swapped = (header.format == PlyFormat::binary_little_endian) != kLittleMachine;
  BinaryBody body(bytes, header.bytes, swapped, file);
  return read_body(body, header, not_finite, file);
}

}  // namespace mapscore::eval
