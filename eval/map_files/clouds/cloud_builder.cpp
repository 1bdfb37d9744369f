// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_builder.hpp"

#include "files/refusal.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mapscore::eval {
namespace {

LabelKind label_kind_of(const CloudMeanings& meanings) {
  if (meanings.has(Meaning::label)) return LabelKind::id;
  if (meanings.has(Meaning::red) || meanings.has(Meaning::packed_colour)) return LabelKind::colour;
  return LabelKind::none;
}

}  // namespace

CloudBuilder::CloudBuilder(const std::filesystem::path& file, const CloudMeanings& meanings,
                           NotFinite not_finite, std::size_t most)
    : file_(file), meanings_(meanings), not_finite_(not_finite) {
  map_.label_kind = label_kind_of(meanings);
  map_.points.reserve(most);
  if (map_.label_kind != LabelKind::none) map_.labels.reserve(most);
  if (meanings.has(Meaning::probability)) map_.probabilities.reserve(most);
  if (meanings.has(Meaning::instance)) map_.instances.reserve(most);
}

void CloudBuilder::refuse_at(PointPlace place, const std::string& what) const {
  if (place.is_line) refuse(file_, place.number, "{}", what);
  refuse(file_, "point {}: {}", place.number, what);
}

std::uint32_t CloudBuilder::whole(double number, const char* what, PointPlace place) const {
  if (!(number >= -2147483648.0 && number <= 4294967295.0) || number != std::floor(number))
    refuse_at(place, fmt::format("{} {} is no whole number of 32 bits; mend it, or name the field "
                                 "otherwise when it is none",
                                 what, number));
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
}

std::uint32_t CloudBuilder::channel(double number, PointPlace place) const {
  const double most = meanings_.real_colours() ? 1.0 : 255.0;
  if (!(number >= 0.0 && number <= most) ||
      (!meanings_.real_colours() && number != std::floor(number)))
    refuse_at(place, fmt::format("{} is not within a colour's range; red, green and blue are whole "
                                 "numbers up to 255, or of a floating-point type and up to 1",
                                 number));
  return static_cast<std::uint32_t>(meanings_.real_colours() ? std::lround(number * 255.0)
                                                             : std::lround(number));
}

std::uint32_t CloudBuilder::colour(const PointNumbers& numbers, PointPlace place) const {
  if (meanings_.has(Meaning::packed_colour))
    return whole(at(numbers, Meaning::packed_colour), "packed colour", place) & 0xffffffu;
  return channel(at(numbers, Meaning::red), place) << 16 |
         channel(at(numbers, Meaning::green), place) << 8 |
         channel(at(numbers, Meaning::blue), place);
}

void CloudBuilder::add(const PointNumbers& numbers, PointPlace place) {
  const Eigen::Vector3d point(at(numbers, Meaning::x), at(numbers, Meaning::y),
                              at(numbers, Meaning::z));
  if (!point.allFinite()) {
    ++skipped_;
    return;
  }
  if (map_.label_kind == LabelKind::id)
    map_.labels.push_back(whole(at(numbers, Meaning::label), "label", place));
  if (map_.label_kind == LabelKind::colour) map_.labels.push_back(colour(numbers, place));
  if (meanings_.has(Meaning::probability)) {
    const double probability = at(numbers, Meaning::probability);
    if (!(probability >= 0.0 && probability <= 1.0))
      refuse_at(place, fmt::format("probability {} is not in [0, 1]; mend it, or name the field "
                                   "otherwise when it is none",
                                   probability));
    map_.probabilities.push_back(probability);
  }
  if (meanings_.has(Meaning::instance)) {
    const double instance = at(numbers, Meaning::instance);
    const std::uint32_t id = whole(instance, "instance", place);
    map_.instances.push_back(instance < 0.0 ? 0 : id);
  }
  map_.points.push_back(point);
}

MapFile CloudBuilder::finish() {
  const std::size_t all = map_.points.size() + skipped_;
  if (all == 0) throw EmptyMap(file_.string() + ": the map is empty");
  if (skipped_ > 0 && not_finite_ == NotFinite::refuse)
    refuse(file_, "{} of {} points are not finite; leave them out with --skip_nan", skipped_, all);
  if (map_.points.empty()) refuse(file_, "the map is empty: none of its {} points is finite", all);
  return std::move(map_);
}

}  // namespace mapscore::eval
