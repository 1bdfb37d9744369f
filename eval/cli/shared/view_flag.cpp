// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/view_flag.hpp"

#include "core/error.hpp"
#include "eval/study/picture_view.hpp"

namespace mapscore::eval {

void ViewFlag::add_to(CLI::App& verb) {
  verb.add_option("--view", numbers,
                  "Draw pictures from an eye towards a target (world, metres), and with a vertical "
                  "field of view in degrees [an overview, and where most errors are]")
      ->expected(6, 7)
      ->type_name("EX EY EZ TX TY TZ [VFOV]");
}

std::optional<sim::View> ViewFlag::view() const {
  if (numbers.empty()) return std::nullopt;
  try {
    return view_of_numbers(numbers);
  } catch (const Error& error) {
    throw Error(std::string("--view: ") + error.what());
  }
}

}  // namespace mapscore::eval
