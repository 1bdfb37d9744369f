// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_builder.hpp"
#include "eval/map_files/clouds/cloud_headers.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <liblzf/lzf.h>

#include <bit>
#include <limits>

namespace mapscore::eval {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD stores the writer's byte order");

/// Compressed bodies of maps unpack to 1.1 to 7 times their size; only voxels of ideal planes, in
/// order, reach 70, and with them a whole room at 1 cm takes 14 MB.
constexpr std::uint32_t kMostRatio = 10;
constexpr std::uint32_t kAlwaysUnpacked = 1 << 24;  // bytes

/// Where a column with a meaning begins, in bytes or words.
struct PcdColumn {
  Meaning meaning;
  ScalarType type;
  std::size_t offset;
};

bool is_padding(const CloudField& field) {
  return field.name == "_";
}

std::size_t bytes_if_solid(const CloudField& field) {
  return is_padding(field) ? 0 : field.bytes();
}

/// Without the zeros with which the Point Cloud Library fills up the last page of a file, where
/// `size` bytes of it are announced.
std::string_view without_page_end(std::string_view body, std::size_t size) {
  constexpr std::size_t kPage = 4096;
  if (body.size() <= size || body.size() - size >= kPage) return body;
  return body.find_first_not_of('\0', size) == body.npos ? body.substr(0, size) : body;
}

const char* size_trouble(bool too_few) {
  return too_few ? "truncated" : "bytes follow the last point";
}

class PcdReader {
 public:
  PcdReader(const std::filesystem::path& file, NotFinite not_finite)
      : file_(file),
        bytes_(read_file(file)),
        header_(parse_pcd_header(bytes_, file)),
        meanings_(header_.fields, file),
        not_finite_(not_finite) {}

  MapFile read() {
    if (header_.data == PcdData::binary) return read_binary();
    return header_.data == PcdData::ascii ? read_ascii() : read_compressed();
  }

 private:
  [[nodiscard]] std::string_view body() const {
    return std::string_view(bytes_).substr(header_.bytes);
  }

  /// What all fields come to, each of them `size_of` it.
  [[nodiscard]] std::size_t sum(auto size_of) const {
    std::size_t sum = 0;
    for (const CloudField& field : header_.fields) sum += size_of(field);
    return sum;
  }

  /// The columns with a meaning, of fields that lie one behind the other, each of them `size_of` it
  /// long.
  [[nodiscard]] std::vector<PcdColumn> columns(auto size_of) const {
    std::vector<PcdColumn> columns;
    std::size_t offset = 0;
    for (std::size_t n = 0; n < header_.fields.size(); ++n) {
      const CloudField& field = header_.fields[n];
      if (const auto meaning = meanings_.meaning(n))
        columns.push_back({*meaning, field.type, offset});
      offset += size_of(field);
    }
    return columns;
  }

  /// Points of which the columns' numbers stand `stride` bytes apart, 0: one behind the other.
  [[nodiscard]] MapFile read_columns(std::string_view body, const std::vector<PcdColumn>& columns,
                                     std::size_t stride) const {
    CloudBuilder cloud(file_, meanings_, not_finite_, header_.points);
    PointNumbers numbers{};
    for (std::size_t point = 0; point < header_.points; ++point) {
      for (const auto& [meaning, type, offset] : columns) {
        const std::size_t step = stride == 0 ? type.size : stride;
        at(numbers, meaning) = number_at(body.data() + offset + point * step, meaning, type, false);
      }
      cloud.add(numbers, {point + 1, false});
    }
    return cloud.finish();
  }

  [[nodiscard]] MapFile read_binary() const {
    const auto bytes_of = [](const CloudField& field) { return field.bytes(); };
    const std::size_t bytes = sum(bytes_of), points = header_.points;
    std::string_view body = this->body();
    if (points <= body.size() / bytes) body = without_page_end(body, points * bytes);
    // Nothing is said of the place of the fault, since the body is one block.
    if (body.size() / bytes != points || body.size() % bytes != 0)
      refuse(file_, "{}: {} points of {} bytes are announced, {} bytes are there",
             size_trouble(body.size() / bytes < points), points, bytes, body.size());
    return read_columns(body, columns(bytes_of), bytes);
  }

  /// The unpacked body; `expected` may be two sizes, with padding and without.
  [[nodiscard]] std::string unpack(std::size_t with_padding, std::size_t without) const {
    std::string_view body = this->body();
    constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
    if (body.size() < kSizes) refuse(file_, "truncated: no sizes of the compressed body");
    std::uint32_t packed = 0, unpacked = 0;
    std::memcpy(&packed, body.data(), sizeof(packed));
    std::memcpy(&unpacked, body.data() + sizeof(packed), sizeof(unpacked));
    body.remove_prefix(kSizes);
    body = without_page_end(body, packed);
    if (packed != body.size())
      refuse(file_, "{}: {} compressed bytes are announced, {} are there",
             size_trouble(body.size() < packed), packed, body.size());
    if (unpacked != with_padding && unpacked != without)
      refuse(file_, "its body unpacks to {} bytes, the header asks for {}", unpacked, without);
    if (unpacked > kAlwaysUnpacked && unpacked / kMostRatio >= packed)
      refuse(file_,
             "{} compressed bytes would unpack to {}, more than {} times as many; is the file "
             "damaged? Else write it as DATA binary",
             packed, unpacked, kMostRatio);
    std::string bytes(unpacked, '\0');
    if (unpacked > 0 && lzf_decompress(body.data(), packed, bytes.data(), unpacked) != unpacked)
      refuse(file_, "its compressed body is damaged; write the file again");
    return bytes;
  }

  /// Lets go of the file's bytes when they are unpacked.
  [[nodiscard]] MapFile read_compressed() {
    const auto bytes_of = [](const CloudField& field) { return field.bytes(); };
    const std::size_t with_padding = sum(bytes_of), without = sum(bytes_if_solid);
    const std::size_t points = header_.points;
    if (points > std::numeric_limits<std::uint32_t>::max() / without)
      refuse(file_, "{} points do not fit into one compressed body", points);
    const std::string bytes = unpack(points * with_padding, points * without);
    std::string().swap(bytes_);
    const bool padded = bytes.size() != points * without;
    const auto all_of = [&](const CloudField& field) {
      return points * (padded ? field.bytes() : bytes_if_solid(field));
    };
    return read_columns(bytes, columns(all_of), 0);
  }

  [[nodiscard]] MapFile read_ascii() const {
    const auto words_of = [](const CloudField& field) { return field.count; };
    const std::size_t words_a_point = sum(words_of), points = header_.points;
    const std::size_t room = (body().size() + 1) / (2 * words_a_point);
    if (points > room)
      refuse(file_, "truncated: {} points are announced, the file has room for {} at most", points,
             room);
    const std::vector<PcdColumn> columns = this->columns(words_of);
    CloudBuilder cloud(file_, meanings_, not_finite_, points);
    TextLines lines(body(), header_.lines + 1);
    PointNumbers numbers{};
    std::vector<std::string_view> words;
    for (std::size_t point = 0; point < points; ++point) {
      if (!lines.next_words(words))
        refuse(file_, "truncated: {} points are announced, {} are there", points, point);
      if (words.size() != words_a_point)
        refuse(file_, lines.number(), "{} numbers, the header announces {}", words.size(),
               words_a_point);
      for (const auto& [meaning, type, word] : columns) {
        const auto number = number_of(words[word], meaning, type);
        if (!number) refuse(file_, lines.number(), "{} is no number", excerpt(words[word]));
        at(numbers, meaning) = *number;
      }
      cloud.add(numbers, {lines.number(), true});
    }
    if (lines.next_words(words)) refuse(file_, lines.number(), "follows the last point");
    return cloud.finish();
  }

  const std::filesystem::path& file_;
  std::string bytes_;
  PcdHeader header_;
  CloudMeanings meanings_;
  NotFinite not_finite_;
};

}  // namespace

MapFile read_pcd(const std::filesystem::path& file, NotFinite not_finite) {
  return PcdReader(file, not_finite).read();
}

}  // namespace mapscore::eval
