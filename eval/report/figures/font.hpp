// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace mapscore::eval {

/// The family that fontconfig takes in the place of one that is not installed; nothing where it is,
/// or where there is no fc-match to ask. `family` is as FigureStyle::check allows.
[[nodiscard]] std::optional<std::string> substitute_font(const std::string& family);

}  // namespace mapscore::eval
