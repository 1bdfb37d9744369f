// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/report/figures/style.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace mapscore::eval {

/// Flags of verbs that draw figures: how these are set.
struct FigureFlags {
  /// Where the verb has --figure or --figures already, they need it.
  void add_to(CLI::App& verb);
  /// Throws Error as FigureStyle::check. Says on standard error when the font is not installed.
  [[nodiscard]] FigureStyle style() const;

 private:
  FigureStyle style_;  ///< but for font and caption
  std::optional<std::string> font_;
  bool no_caption_ = false;
};

}  // namespace mapscore::eval
