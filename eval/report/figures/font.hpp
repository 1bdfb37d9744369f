// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace mapscore::eval {

/// The family that fontconfig takes in the place of one that is not installed; nothing where it is,
/// or where there is no fc-match to ask. `family` is as FigureStyle::check allows.
[[nodiscard]] std::optional<std::string> substitute_font(const std::string& family);

/// A gnuplot script with '?' for every letter that gnuplot's cairo would draw as a blot over the
/// page: those that no installed font has or only one of colours (by fc-list, where it is there),
/// and all beyond the Basic Multilingual Plane. U+FE0F, which asks for an emoji, is left out.
[[nodiscard]] std::string drawable(std::string script);

}  // namespace mapscore::eval
