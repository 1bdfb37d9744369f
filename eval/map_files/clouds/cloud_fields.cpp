// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_fields.hpp"

#include "eval/map_files/refusal.hpp"
#include "files/lower_case.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

namespace mapscore::eval {
namespace {

using Names = std::initializer_list<std::string_view>;

/// Column of the first name that is there.
std::optional<std::size_t> first_of(std::span<const CloudField> fields, Names names) {
  for (const std::string_view name : names)
    for (std::size_t column = 0; column < fields.size(); ++column)
      if (lower_case(fields[column].name) == name) return column;
  return std::nullopt;
}

void refuse_doubled(std::span<const CloudField> fields, const std::filesystem::path& file) {
  std::set<std::string_view> seen;
  for (const CloudField& field : fields)
    if (field.name != "_" && !seen.insert(field.name).second)
      refuse(file, fmt::format("field {} stands twice; rename one", shown(field.name)));
}

}  // namespace

CloudMeanings::CloudMeanings(std::span<const CloudField> fields,
                             const std::filesystem::path& file) {
  refuse_doubled(fields, file);
  const auto set = [&](Meaning meaning, Names names) {
    columns_[static_cast<std::size_t>(meaning)] = first_of(fields, names);
  };
  set(Meaning::x, {"x"});
  set(Meaning::y, {"y"});
  set(Meaning::z, {"z"});
  if (!has(Meaning::x) || !has(Meaning::y) || !has(Meaning::z))
    refuse(file, "the points have no x, y and z; name the coordinates so");
  set(Meaning::probability, {"probability", "confidence", "score", "scalar_probability"});
  set(Meaning::instance, {"instance", "instance_id", "object_id", "scalar_instance"});
  take_label_or_colour(fields);

  for (const auto& column : columns_)
    if (column && !fields[*column].single)
      refuse(file, fmt::format("field {} is a list; it needs one number a point",
                               shown(fields[*column].name)));
  const auto packed = column(Meaning::packed_colour);
  if (packed && size_of(fields[*packed].type) != 4)
    refuse(file, fmt::format("field {} is {} bytes wide; a packed colour has 4",
                             shown(fields[*packed].name), size_of(fields[*packed].type)));
}

void CloudMeanings::take_label_or_colour(std::span<const CloudField> fields) {
  auto& label = columns_[static_cast<std::size_t>(Meaning::label)];
  label = first_of(fields, {"label", "class", "class_id", "semantic", "scalar_label",
                            "scalar_class", "classification", "scalar_classification", "category"});
  if (label) return;
  for (const std::string_view head : {"", "diffuse_"}) {
    for (const bool whole_words : {true, false}) {
      const auto channel = [&](std::string_view word) {
        const std::string name(whole_words ? word : word.substr(0, 1));
        return first_of(fields, {std::string(head) + name});
      };
      const auto red = channel("red"), green = channel("green"), blue = channel("blue");
      if (!red || !green || !blue) continue;
      columns_[static_cast<std::size_t>(Meaning::red)] = red;
      columns_[static_cast<std::size_t>(Meaning::green)] = green;
      columns_[static_cast<std::size_t>(Meaning::blue)] = blue;
      real_colours_ = is_real(fields[*red].type);
      return;
    }
  }
  columns_[static_cast<std::size_t>(Meaning::packed_colour)] = first_of(fields, {"rgb", "rgba"});
}

std::optional<Meaning> CloudMeanings::meaning(std::size_t column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), std::optional(column));
  if (found == columns_.end()) return std::nullopt;
  return static_cast<Meaning>(found - columns_.begin());
}

double number_at(const char* bytes, Meaning meaning, ScalarType type, bool swapped) {
  const bool packed = meaning == Meaning::packed_colour;
  return scalar_at(bytes, packed ? ScalarType::uint32 : type, swapped);
}

std::optional<double> number_of(std::string_view word, Meaning meaning, ScalarType type) {
  if (meaning != Meaning::packed_colour || !is_real(type)) return parse_real(word);
  const auto packed = parse_float(word);
  // Its bits went when it was printed; the point may still be one to leave out.
  if (packed && std::isnan(*packed)) return std::numeric_limits<double>::quiet_NaN();
  return packed ? std::optional<double>(std::bit_cast<std::uint32_t>(*packed)) : std::nullopt;
}

}  // namespace mapscore::eval
