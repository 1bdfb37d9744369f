// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/clouds/cloud_fields.hpp"

#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

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
      refuse(file, "field {} stands twice; rename one", excerpt(field.name));
}

}  // namespace

CloudMeanings::CloudMeanings(std::span<const CloudField> fields,
                             const std::filesystem::path& file) {
  refuse_doubled(fields, file);
  const auto set = [&](Meaning meaning, Names names) {
    at(columns_, meaning) = first_of(fields, names);
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
    if (column && !fields[*column].single())
      refuse(file, "field {} is a list; it needs one number a point",
             excerpt(fields[*column].name));
  const auto packed = at(columns_, Meaning::packed_colour);
  if (packed && fields[*packed].type.size != 4)
    refuse(file, "field {} is {} bytes wide; a packed colour has 4", excerpt(fields[*packed].name),
           fields[*packed].type.size);
}

void CloudMeanings::take_label_or_colour(std::span<const CloudField> fields) {
  auto& label = at(columns_, Meaning::label);
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
      at(columns_, Meaning::red) = red;
      at(columns_, Meaning::green) = green;
      at(columns_, Meaning::blue) = blue;
      real_colours_ = fields[*red].type.is_real;
      return;
    }
  }
  at(columns_, Meaning::packed_colour) = first_of(fields, {"rgb", "rgba"});
}

std::optional<Meaning> CloudMeanings::meaning(std::size_t column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), std::optional(column));
  if (found == columns_.end()) return std::nullopt;
  return static_cast<Meaning>(found - columns_.begin());
}

double number_at(const char* bytes, Meaning meaning, ScalarType type, bool swapped) {
  return (meaning == Meaning::packed_colour ? kScalar<std::uint32_t> : type).at(bytes, swapped);
}

std::optional<double> number_of(std::string_view word, Meaning meaning, ScalarType type) {
  if (meaning != Meaning::packed_colour || !type.is_real) return parse_real(word);
  const auto packed = parse_float(word);
  // Its bits went when it was printed; the point may still be one to leave out.
  if (packed && std::isnan(*packed)) return std::numeric_limits<double>::quiet_NaN();
  return packed ? std::optional<double>(std::bit_cast<std::uint32_t>(*packed)) : std::nullopt;
}

}  // namespace mapscore::eval
