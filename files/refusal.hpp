// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/error.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <utility>

namespace mapscore {

/// Throws Error "FILE: WHAT"; `what` and its arguments are those of fmt::format.
template <class... Args>
[[noreturn]] void refuse(const std::filesystem::path& file, fmt::format_string<Args...> what,
                         Args&&... args) {
  throw Error(file.string() + ": " + fmt::format(what, std::forward<Args>(args)...));
}

/// Throws Error "FILE:LINE: WHAT"; lines count from 1.
template <class... Args>
[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line,
                         fmt::format_string<Args...> what, Args&&... args) {
  throw Error(fmt::format("{}:{}: ", file.string(), line) +
              fmt::format(what, std::forward<Args>(args)...));
}

}  // namespace mapscore
