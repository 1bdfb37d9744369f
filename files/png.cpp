// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/png.hpp"

#include "core/error.hpp"
#include "files/png_rows.hpp"
#include "files/zlib_text.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <memory>

namespace mapscore {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kChunkFrame = 12;  // length, type, CRC

/// What an IHDR says of a pixel.
struct PixelType {
  std::uint8_t bit_depth, colour_type;
  std::size_t bytes;
  const char* name;
  /// Fastest at a reasonable size: noise in colours makes level 2 twice as slow for 2 % fewer
  /// bytes.
  int level;
};
constexpr PixelType kColour{8, 2, 3, "8-bit RGB", 1};
constexpr PixelType kGrey16{16, 0, 2, "16-bit grey", 2};

/// Rows of less than a byte a pixel are filled up to whole bytes.
RowLayout layout_of(cv::Size size, const PixelType& type) {
  const std::size_t bits = type.bit_depth < 8 ? type.bit_depth : 8 * type.bytes;
  return {size.height, (static_cast<std::size_t>(size.width) * bits + 7) / 8, type.bytes};
}

/// The kind that an image of ids has by its header, which is yet to be checked.
PixelType id_type_of(std::string_view png) {
  constexpr std::size_t kBitDepth = 24, kColourType = 25;  // after signature, length, type and size
  constexpr const char* kName = "grey or palette of up to 16 bits";
  const auto bits = static_cast<std::uint8_t>(png.size() > kColourType ? png[kBitDepth] : 16);
  const auto colour = static_cast<std::uint8_t>(png.size() > kColourType ? png[kColourType] : 0);
  const bool narrow = bits == 1 || bits == 2 || bits == 4 || bits == 8;
  if (narrow && (colour == 0 || colour == 3)) return {bits, colour, 1, kName, 0};
  return {16, 0, 2, kName, 0};
}

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 255),
          static_cast<char>(value >> 8 & 255), static_cast<char>(value & 255)};
}

std::uint32_t from_big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

std::uint32_t crc_of(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

void append_chunk(std::string& png, const char* type, std::string_view data) {
  png += big_endian(static_cast<std::uint32_t>(data.size()));
  const std::size_t start = png.size();
  png.append(type).append(data);
  png += big_endian(crc_of(std::string_view(png).substr(start)));
}

std::string header_of(cv::Size size, const PixelType& type) {
  std::string header = big_endian(static_cast<std::uint32_t>(size.width)) +
                       big_endian(static_cast<std::uint32_t>(size.height));
  header += static_cast<char>(type.bit_depth);
  header += static_cast<char>(type.colour_type);
  return header.append(3, '\0');  // deflate, adaptive filters, not interlaced
}

std::string png_of(const std::string& pixels, cv::Size size, const PixelType& type) {
  std::string png(kSignature);
  append_chunk(png, "IHDR", header_of(size, type));
  append_chunk(png, "IDAT", zlib_packed(filter_rows(pixels, layout_of(size, type)), type.level));
  append_chunk(png, "IEND", {});
  return png;
}

[[noreturn]] void refuse_png(const std::string& name, const std::string& what) {
  throw Error(fmt::format("{}: {}; copy the file anew or make the recording again", name, what));
}

struct Chunk {
  std::string_view type, data;
};

/// The chunk at `offset`, verified; `offset` moves past it.
Chunk next_chunk(std::string_view png, std::size_t& offset, const std::string& name) {
  const std::size_t left = png.size() - offset;
  const std::size_t length = left < kChunkFrame ? 0 : from_big_endian(png.substr(offset));
  if (left < kChunkFrame || length > left - kChunkFrame)
    refuse_png(name, fmt::format("PNG cut off after {} bytes", png.size()));
  const std::string_view checked = png.substr(offset + 4, 4 + length);
  if (crc_of(checked) != from_big_endian(png.substr(offset + 8 + length)))
    refuse_png(name, fmt::format("PNG chunk at byte {} is damaged (wrong CRC)", offset));
  offset += kChunkFrame + length;
  return {checked.substr(0, 4), checked.substr(4)};
}

void check_header(const Chunk& chunk, cv::Size size, const PixelType& type,
                  const std::string& name) {
  if (chunk.type != "IHDR" || chunk.data.size() != 13) refuse_png(name, "PNG without a header");
  const std::uint32_t width = from_big_endian(chunk.data);
  const std::uint32_t height = from_big_endian(chunk.data.substr(4));
  if (width != static_cast<std::uint32_t>(size.width) ||
      height != static_cast<std::uint32_t>(size.height))
    throw Error(fmt::format("{}: image is {} x {}, recording.yaml says {} x {}; make the two agree",
                            name, width, height, size.width, size.height));
  if (chunk.data.substr(8) != header_of(size, type).substr(8))
    throw Error(fmt::format("{}: image is not {}, not interlaced; convert it", name, type.name));
}

/// Walks all chunks and returns the joined data of IDAT. Chunks that may be ignored are, after
/// their CRC; what follows IEND is refused.
std::string compressed_pixels(std::string_view png, cv::Size size, const PixelType& type,
                              const std::string& name) {
  if (png.substr(0, kSignature.size()) != kSignature) refuse_png(name, "not a PNG file");
  std::size_t offset = kSignature.size();
  check_header(next_chunk(png, offset, name), size, type, name);
  std::string compressed;
  for (Chunk chunk = next_chunk(png, offset, name); chunk.type != "IEND";
       chunk = next_chunk(png, offset, name)) {
    const bool critical = (chunk.type[0] & 0x20) == 0;
    if (chunk.type == "IDAT")
      compressed += chunk.data;
    else if (critical && chunk.type != "PLTE")
      refuse_png(name, fmt::format("PNG with an unknown chunk before byte {}", offset));
  }
  if (offset != png.size()) refuse_png(name, "bytes after the end of the PNG");
  return compressed;
}

/// Filtered rows undone; each row still has its filter's byte before it.
std::unique_ptr<std::uint8_t[]> rows_of(std::string_view png, cv::Size size, const PixelType& type,
                                        const std::string& name) {
  const std::string compressed = compressed_pixels(png, size, type, name);
  const RowLayout layout = layout_of(size, type);
  const std::size_t bytes = static_cast<std::size_t>(layout.rows) * (1 + layout.row_bytes);
  auto rows = std::make_unique_for_overwrite<std::uint8_t[]>(bytes);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  const auto result = libdeflate_zlib_decompress(inflater.get(), compressed.data(),
                                                 compressed.size(), rows.get(), bytes, nullptr);
  if (result != LIBDEFLATE_SUCCESS) refuse_png(name, "PNG with damaged pixel data");
  if (!unfilter_rows(rows.get(), layout)) refuse_png(name, "PNG with an unknown row filter");
  return rows;
}

/// 16-bit pixels of unfiltered rows.
cv::Mat1w grey16_of(const std::uint8_t* rows, cv::Size size) {
  cv::Mat1w image(size);
  for (int v = 0; v < size.height; ++v) {
    ++rows;
    std::uint16_t* row = image[v];
    for (int u = 0; u < size.width; ++u, rows += 2)
      row[u] = static_cast<std::uint16_t>(rows[0] << 8 | rows[1]);
  }
  return image;
}

}  // namespace

std::string too_many_pixels(int width_px, int height_px) {
  if (std::int64_t{width_px} * height_px <= kMostImagePixels) return {};
  return fmt::format("{} x {} pixels are more than {}, as of 4096 x 4096; make the images smaller",
                     width_px, height_px, kMostImagePixels);
}

cv::Size png_size(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kWidth = 16, kHeight = 20;  // after signature, length and type
  constexpr std::uint32_t kMost = kMostImageSide_px;
  if (!bytes.starts_with(kSignature) || bytes.size() < kHeight + 4)
    throw Error(name + ": is no PNG file; convert it, or copy it anew");
  const std::uint32_t width = from_big_endian(bytes.substr(kWidth));
  const std::uint32_t height = from_big_endian(bytes.substr(kHeight));
  if (width < 1 || width > kMost || height < 1 || height > kMost)
    throw Error(name + ": its header says no size of 1 to 16384 pixels; copy the file anew");
  const cv::Size size(static_cast<int>(width), static_cast<int>(height));
  if (const std::string problem = too_many_pixels(size.width, size.height); !problem.empty())
    throw Error(name + ": " + problem);
  return size;
}

std::string encode_png(const cv::Mat3b& image) {
  std::string pixels(image.total() * kColour.bytes, '\0');
  char* out = pixels.data();
  for (int v = 0; v < image.rows; ++v) {
    const cv::Vec3b* row = image[v];
    for (int u = 0; u < image.cols; ++u, out += 3)
      for (int channel = 0; channel < 3; ++channel)
        out[channel] = static_cast<char>(row[u][2 - channel]);
  }
  return png_of(pixels, image.size(), kColour);
}

std::string encode_png(const cv::Mat1w& image) {
  std::string pixels(image.total() * kGrey16.bytes, '\0');
  char* out = pixels.data();
  for (int v = 0; v < image.rows; ++v) {
    const std::uint16_t* row = image[v];
    for (int u = 0; u < image.cols; ++u) {
      *out++ = static_cast<char>(row[u] >> 8);
      *out++ = static_cast<char>(row[u] & 255);
    }
  }
  return png_of(pixels, image.size(), kGrey16);
}

cv::Mat3b decode_color_png(std::string_view bytes, cv::Size size, const std::string& name) {
  const auto rows = rows_of(bytes, size, kColour, name);
  cv::Mat3b image(size);
  const std::uint8_t* in = rows.get();
  for (int v = 0; v < size.height; ++v) {
    ++in;
    cv::Vec3b* row = image[v];
    for (int u = 0; u < size.width; ++u, in += 3) row[u] = cv::Vec3b(in[2], in[1], in[0]);
  }
  return image;
}

cv::Mat1w decode_grey16_png(std::string_view bytes, cv::Size size, const std::string& name) {
  return grey16_of(rows_of(bytes, size, kGrey16, name).get(), size);
}

cv::Mat1w decode_id_png(std::string_view bytes, cv::Size size, const std::string& name) {
  const PixelType type = id_type_of(bytes);
  const auto rows = rows_of(bytes, size, type, name);
  if (type.bit_depth == 16) return grey16_of(rows.get(), size);
  const std::size_t stride = 1 + layout_of(size, type).row_bytes;
  const int per_byte = 8 / type.bit_depth, mask = (1 << type.bit_depth) - 1;
  cv::Mat1w image(size);
  for (int v = 0; v < size.height; ++v) {
    const std::uint8_t* in = rows.get() + static_cast<std::size_t>(v) * stride + 1;
    for (int u = 0; u < size.width; ++u) {  // the leftmost pixel in the highest bits
      const int shift = (per_byte - 1 - u % per_byte) * type.bit_depth;
      image(v, u) = static_cast<std::uint16_t>(in[u / per_byte] >> shift & mask);
    }
  }
  return image;
}

}  // namespace mapscore
