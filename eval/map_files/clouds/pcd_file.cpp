// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/pcd_file.hpp"

#include "eval/map_files/clouds/cloud_builder.hpp"
#include "eval/map_files/clouds/pcd_header.hpp"
#include "eval/map_files/refusal.hpp"
#include "files/file_bytes.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace mapscore::eval {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD stores the writer's byte order");

/// Compressed bodies of maps unpack to 1.1 to 7 times their size; only voxels of ideal planes, in
/// order, reach 70, and with them a whole room at 1 cm takes 14 MB.
constexpr std::uint32_t kMostRatio = 10;
constexpr std::uint32_t kAlwaysUnpacked = 1 << 24;  // bytes

/// Where a column with a meaning begins, and how far it is to the next point.
struct Column {
  Meaning meaning;
  ScalarType type;
  std::size_t offset;
  std::size_t stride;
};

CloudMeanings meanings_of(const PcdHeader& header, const std::filesystem::path& file) {
  std::vector<CloudField> fields;
  for (const PcdField& field : header.fields) fields.push_back(field.field);
  return {fields, file};
}

bool is_padding(const PcdField& field) {
  return field.field.name == "_";
}

std::size_t bytes_a_point(const std::vector<PcdField>& fields) {
  std::size_t bytes = 0;
  for (const PcdField& field : fields) bytes += field.bytes();
  return bytes;
}

/// Columns of points that lie one behind the other.
std::vector<Column> columns_by_point(const PcdHeader& header, const CloudMeanings& meanings) {
  std::vector<Column> columns;
  const std::size_t stride = bytes_a_point(header.fields);
  std::size_t offset = 0;
  for (std::size_t n = 0; n < header.fields.size(); ++n) {
    if (const auto meaning = meanings.meaning(n))
      columns.push_back({*meaning, header.fields[n].field.type, offset, stride});
    offset += header.fields[n].bytes();
  }
  return columns;
}

/// Columns of fields that lie one behind the other, each with all its points.
std::vector<Column> columns_by_field(const PcdHeader& header, const CloudMeanings& meanings,
                                     bool with_padding) {
  std::vector<Column> columns;
  std::size_t offset = 0;
  for (std::size_t n = 0; n < header.fields.size(); ++n) {
    const PcdField& field = header.fields[n];
    if (is_padding(field) && !with_padding) continue;
    if (const auto meaning = meanings.meaning(n))
      columns.push_back({*meaning, field.field.type, offset, field.bytes()});
    offset += field.bytes() * header.points;
  }
  return columns;
}

MapFile read_columns(std::string_view body, const std::vector<Column>& columns, std::size_t points,
                     CloudBuilder cloud) {
  PointNumbers numbers{};
  for (std::size_t point = 0; point < points; ++point) {
    for (const Column& column : columns)
      at(numbers, column.meaning) = number_at(body.data() + column.offset + point * column.stride,
                                              column.meaning, column.type, false);
    cloud.add(numbers, {point + 1, false});
  }
  return cloud.finish();
}

/// Nothing is said of the place of the fault, since the body is one block.
[[noreturn]] void refuse_size(const std::filesystem::path& file, std::size_t points,
                              std::size_t bytes, std::size_t left) {
  refuse(file, fmt::format("{}: {} points of {} bytes are announced, {} bytes are there",
                           left / bytes < points ? "truncated" : "bytes follow the last point",
                           points, bytes, left));
}

/// Without the zeros with which the Point Cloud Library fills up the last page of a file, where
/// `size` bytes of it are announced.
std::string_view without_page_end(std::string_view body, std::size_t size) {
  constexpr std::size_t kPage = 4096;
  if (body.size() <= size || body.size() - size >= kPage) return body;
  return body.find_first_not_of('\0', size) == body.npos ? body.substr(0, size) : body;
}

MapFile read_binary(std::string_view body, const PcdHeader& header, NotFinite not_finite,
                    const std::filesystem::path& file) {
  const CloudMeanings meanings = meanings_of(header, file);
  const std::size_t bytes = bytes_a_point(header.fields);
  if (header.points <= body.size() / bytes) body = without_page_end(body, header.points * bytes);
  if (body.size() / bytes != header.points || body.size() % bytes != 0)
    refuse_size(file, header.points, bytes, body.size());
  return read_columns(body, columns_by_point(header, meanings), header.points,
                      CloudBuilder(file, meanings, not_finite, header.points));
}

/// The unpacked body; `expected` may be two sizes, with padding and without.
std::string unpack(std::string_view body, std::size_t with_padding, std::size_t without,
                   const std::filesystem::path& file) {
  constexpr std::size_t kSizes = 2 * sizeof(std::uint32_t);
  if (body.size() < kSizes) refuse(file, "truncated: no sizes of the compressed body");
  std::uint32_t packed = 0, unpacked = 0;
  std::memcpy(&packed, body.data(), sizeof(packed));
  std::memcpy(&unpacked, body.data() + sizeof(packed), sizeof(unpacked));
  body.remove_prefix(kSizes);
  body = without_page_end(body, packed);
  if (packed != body.size())
    refuse(file, fmt::format("{}: {} compressed bytes are announced, {} are there",
                             body.size() < packed ? "truncated" : "bytes follow the last point",
                             packed, body.size()));
  if (unpacked != with_padding && unpacked != without)
    refuse(file,
           fmt::format("its body unpacks to {} bytes, the header asks for {}", unpacked, without));
  if (unpacked > kAlwaysUnpacked && unpacked / kMostRatio >= packed)
    refuse(file, fmt::format("{} compressed bytes would unpack to {}, more than {} times as many; "
                             "is the file damaged? Else write it as DATA binary",
                             packed, unpacked, kMostRatio));
  std::string bytes(unpacked, '\0');
  if (unpacked > 0 && lzf_decompress(body.data(), packed, bytes.data(), unpacked) != unpacked)
    refuse(file, "its compressed body is damaged; write the file again");
  return bytes;
}

/// Lets go of the file's bytes when they are unpacked.
MapFile read_compressed(std::string file_bytes, const PcdHeader& header, NotFinite not_finite,
                        const std::filesystem::path& file) {
  const CloudMeanings meanings = meanings_of(header, file);
  std::vector<PcdField> solid = header.fields;
  std::erase_if(solid, is_padding);
  const std::size_t with_padding = bytes_a_point(header.fields), without = bytes_a_point(solid);
  if (header.points > std::numeric_limits<std::uint32_t>::max() / without)
    refuse(file, fmt::format("{} points do not fit into one compressed body", header.points));
  const std::string bytes = unpack(std::string_view(file_bytes).substr(header.bytes),
                                   header.points * with_padding, header.points * without, file);
  std::string().swap(file_bytes);
  const bool padded = bytes.size() != header.points * without;
  return read_columns(bytes, columns_by_field(header, meanings, padded), header.points,
                      CloudBuilder(file, meanings, not_finite, header.points));
}

MapFile read_ascii(std::string_view body, const PcdHeader& header, NotFinite not_finite,
                   const std::filesystem::path& file) {
  const CloudMeanings meanings = meanings_of(header, file);
  std::size_t words_a_point = 0;
  std::vector<Column> columns;
  for (std::size_t n = 0; n < header.fields.size(); ++n) {
    if (const auto meaning = meanings.meaning(n))
      columns.push_back({*meaning, header.fields[n].field.type, words_a_point, 0});
    words_a_point += header.fields[n].count;
  }
  if (header.points > (body.size() + 1) / (2 * words_a_point))
    refuse(file, fmt::format("truncated: {} points are announced, the file has room for {} at most",
                             header.points, (body.size() + 1) / (2 * words_a_point)));

  CloudBuilder cloud(file, meanings, not_finite, header.points);
  TextLines lines(body, header.lines + 1);
  PointNumbers numbers{};
  std::vector<std::string_view> words;
  for (std::size_t point = 0; point < header.points; ++point) {
    if (!lines.next_words(words))
      refuse(file,
             fmt::format("truncated: {} points are announced, {} are there", header.points, point));
    if (words.size() != words_a_point)
      refuse(file, lines.number(),
             fmt::format("{} numbers, the header announces {}", words.size(), words_a_point));
    for (const Column& column : columns) {
      const auto number = number_of(words[column.offset], column.meaning, column.type);
      if (!number)
        refuse(file, lines.number(), fmt::format("{} is no number", shown(words[column.offset])));
      at(numbers, column.meaning) = *number;
    }
    cloud.add(numbers, {lines.number(), true});
  }
  if (lines.next_words(words)) refuse(file, lines.number(), "follows the last point");
  return cloud.finish();
}

}  // namespace

MapFile read_pcd(const std::filesystem::path& file, NotFinite not_finite) {
  std::string bytes = read_file(file);
  const PcdHeader header = parse_pcd_header(bytes, file);
  const std::string_view body = std::string_view(bytes).substr(header.bytes);
  if (header.data == PcdData::binary) return read_binary(body, header, not_finite, file);
  if (header.data == PcdData::ascii) return read_ascii(body, header, not_finite, file);
  return read_compressed(std::move(bytes), header, not_finite, file);
}

}  // namespace mapscore::eval
