// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/sampling.hpp"

#include "core/error.hpp"
#include "core/random_stream.hpp"

#include <boost/random/sobol.hpp>
#include <fmt/format.h>

#include <numeric>
#include <utility>
#include <variant>

namespace mapscore::eval {
namespace {

using Points = std::vector<std::vector<double>>;

Points points_by(const FullGrid&, std::size_t, std::uint64_t) {
  return {};
}

/// A permutation of the parts of each axis (Fisher and Yates), and a place within each part.
Points points_by(const LatinHypercube& of, std::size_t dimensions, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(of.points);
  Points points(count, std::vector<double>(dimensions));
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    RandomStream stream(seed, "latin hypercube", {axis});
    std::vector<std::size_t> parts(count);
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    for (std::size_t n = count; n > 1; --n)
      std::swap(parts[n - 1],
                parts[static_cast<std::size_t>(stream.uniform() * static_cast<double>(n))]);
    for (std::size_t n = 0; n < count; ++n)
      points[n][axis] =
          (static_cast<double>(parts[n]) + stream.uniform()) / static_cast<double>(count);
  }
  return points;
}

Points points_by(const Sobol& of, std::size_t dimensions, std::uint64_t) {
  Points points(static_cast<std::size_t>(of.points), std::vector<double>(dimensions));
  constexpr std::size_t kMostPaths = 1000;
  if (dimensions > kMostPaths)
    throw Error(fmt::format("sampling: {} swept paths; Sobol's sequence is for up to {}",
                            dimensions, kMostPaths));
  boost::random::sobol sequence(dimensions);  // it leaves out the origin, its first point
  for (std::size_t n = 1; n < points.size(); ++n)
    for (double& at : points[n]) at = static_cast<double>(sequence() >> 11) * 0x1p-53;
  return points;
}

}  // namespace

int points_of(const Sampling& sampling) {
  return std::visit(
      [](const auto& of) {
        if constexpr (requires { of.points; }) return of.points;
        return 0;
      },
      sampling);
}

std::vector<std::vector<double>> unit_points(const Sampling& sampling, std::size_t dimensions,
                                             std::uint64_t seed) {
  return std::visit([&](const auto& of) { return points_by(of, dimensions, seed); }, sampling);
}

}  // namespace mapscore::eval
