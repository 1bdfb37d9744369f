// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/frontier.hpp"

#include <algorithm>

namespace mapscore::eval {

std::vector<double> frontier_doses(double low, double high, std::span<const Tolerance> alone) {
  std::vector<double> ends;
  for (const Tolerance& of : alone)
    if (const double end = of.dose.value_or(of.high.value_or(high)); end > low) ends.push_back(end);
  if (ends.empty()) ends = {high};  // no method bears any dose: nothing is known of where to look
  std::ranges::sort(ends);
  const int steps = ends.back() < high ? kFrontierDoses : kFrontierDoses - 1;
  constexpr double kRounding = 1e-9;

  std::vector<double> doses{low};
  double from = low, share = 0.0;
  for (auto end = ends.begin(); end != ends.end(); ++end) {
    double density = 0.0;  // of all methods whose end is not yet behind
    for (auto wanting = end; wanting != ends.end(); ++wanting)
      density += 1.0 / (*wanting - low) / static_cast<double>(ends.size());
    for (int n = static_cast<int>(doses.size()); n < kFrontierDoses; ++n) {
      const double dose = from + (static_cast<double>(n) / steps - share) / density;
      if (dose > *end + kRounding * (*end - low)) break;
      doses.push_back(std::min(dose, *end));
    }
    share += density * (*end - from);
    from = *end;
  }
  return doses;
}

}  // namespace mapscore::eval
