// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

namespace mapscore {

// Bytes as a zlib stream (RFC 1950), by libdeflate. Pure: the same bytes give the same stream with
// one release of libdeflate.

/// `level`: 1, fast, to 12, small.
[[nodiscard]] std::string zlib_packed(std::string_view bytes, int level);

/// Throws Error when it is no whole zlib stream, or holds more than `most_bytes`.
[[nodiscard]] std::string zlib_unpacked(std::string_view stream, std::size_t most_bytes);

}  // namespace mapscore
