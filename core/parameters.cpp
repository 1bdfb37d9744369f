// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/parameters.hpp"

#include "core/error.hpp"

#include <cmath>
#include <sstream>

namespace mapscore {
namespace {

/// As people write it: 0.005, 1000000000.
std::string text_of(double number) {
  std::ostringstream text;
  text.precision(15);
  text << number;
  return text.str();
}

}  // namespace

std::string Range::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  const std::string from = (open_low ? "above " : "from ") + text_of(low);
  const std::string to = (open_high ? "below " : "up to ") + text_of(high);
  if (has_low && has_high) return from + ", " + to;
  if (has_low) return open_low ? from : from + " up";
  return has_high ? to : "any";
}

void fail_out_of_range(std::string_view what, double value, const Range& range) {
  throw Error(std::string(what) + ": " + text_of(value) + " is out of range; give a number " +
              range.text());
}

}  // namespace mapscore
