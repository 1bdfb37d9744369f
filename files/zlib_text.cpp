// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/zlib_text.hpp"

#include "core/error.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

namespace mapscore {

std::string zlib_packed(std::string_view bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  std::string out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  return out;
}

std::string zlib_unpacked(std::string_view stream, std::size_t most_bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  for (std::size_t room = std::min(most_bytes, 16 * stream.size());;
       room = std::min(most_bytes, 4 * room)) {
    std::string bytes(room, '\0');
    std::size_t size = 0;
    const auto result = libdeflate_zlib_decompress(inflater.get(), stream.data(), stream.size(),
                                                   bytes.data(), bytes.size(), &size);
    if (result == LIBDEFLATE_SUCCESS) {
      bytes.resize(size);
      return bytes;
    }
    if (result != LIBDEFLATE_INSUFFICIENT_SPACE || room == most_bytes || room == 0)
      throw Error("damaged or too large zlib stream");
  }
}

}  // namespace mapscore
