// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/picture_view.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mapscore::eval {

sim::View view_of_numbers(std::span<const double> numbers) {
  constexpr double kFarthest_m = 1e6, kClosest_m = 1e-3;
  if (numbers.size() != 6 && numbers.size() != 7)
    throw Error(
        fmt::format("a view of {} numbers; write eye and target in metres, and perhaps the "
                    "vertical field of view in degrees: EX EY EZ TX TY TZ [VFOV]",
                    numbers.size()));
  for (const double number : numbers)
    if (!(std::abs(number) <= kFarthest_m))
      throw Error(fmt::format("{} in a view; write metres within +-1e6", number));
  sim::View view;
  view.eye_m = {numbers[0], numbers[1], numbers[2]};
  view.target_m = {numbers[3], numbers[4], numbers[5]};
  if ((view.target_m - view.eye_m).norm() < kClosest_m)
    throw Error("eye and target of a view are the same point; move one");
  if (numbers.size() == 7) view.vfov_deg = numbers[6];
  if (!(view.vfov_deg >= 1.0 && view.vfov_deg <= 170.0))
    throw Error(fmt::format("a view's vertical field of view is {} degrees; write 1 to 170",
                            view.vfov_deg));
  return view;
}

}  // namespace mapscore::eval
