// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "sim/render/renderer.hpp"

#include <CLI/CLI.hpp>

#include <optional>
#include <vector>

namespace mapscore::eval {

/// `--view EX EY EZ TX TY TZ [VFOV]`: where pictures are drawn from.
struct ViewFlag {
  std::vector<double> numbers;

  void add_to(CLI::App& verb);
  /// None when the flag is not given. Throws Error when it says no view.
  [[nodiscard]] std::optional<sim::View> view() const;
};

}  // namespace mapscore::eval
