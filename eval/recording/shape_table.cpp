// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/shape_table.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <fmt/format.h>

#include <optional>
#include <sstream>

namespace mapscore::eval {
namespace {

constexpr const char* kHeader = "kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz";
constexpr std::size_t kColumns = 13;
constexpr ShapeKind kKinds[] = {ShapeKind::plane,     ShapeKind::sphere,   ShapeKind::capsule,
                                ShapeKind::ellipsoid, ShapeKind::cylinder, ShapeKind::box};

bool has_extent(const Shape& shape) {
  return (shape.size.head(sizes_of(shape.kind)).array() > 0.0).all() && shape.size.allFinite();
}

std::string line_of(const Shape& shape) {
  const PoseNumbers pose = numbers_of(shape.T_world_shape);
  if (!pose_of(pose) || !has_extent(shape))
    throw Error(
        fmt::format("geom '{}': pose is not finite or a size not above 0; mend it in the "
                    "scene",
                    shape.name));
  return fmt::format("{},{},{},{},{},{},{}\n", name_of(shape.kind), shape.instance,
                     csv_cell(shown(shape.name)), join_numbers(pose, ","), shape.size.x(),
                     shape.size.y(), shape.size.z());
}

std::optional<ShapeKind> kind_of(const std::string& name) {
  for (const ShapeKind kind : kKinds)
    if (name == name_of(kind)) return kind;
  return std::nullopt;
}

/// The shape of one line, or what is wrong with it.
struct Parsed {
  Shape shape;
  std::string wrong;
};

Parsed parse(const std::string& line, std::size_t instance_count) {
  const auto fields = csv_cells(line, kColumns);
  if (!fields || fields->size() != kColumns)
    return {{}, fmt::format("expected {} columns", kColumns)};
  Parsed parsed;
  const auto kind = kind_of((*fields)[0]);
  if (!kind) return {{}, fmt::format("unknown kind '{}'", (*fields)[0])};
  const auto instance = parse_number((*fields)[1]);
  if (!instance || *instance < 0 || *instance >= static_cast<double>(instance_count) ||
      *instance != static_cast<InstanceId>(*instance))
    return {{}, fmt::format("instance '{}' is not in recording.yaml", (*fields)[1])};
  std::array<double, 10> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parse_number((*fields)[i + 3]);
    if (!number) return {{}, fmt::format("'{}' is not a finite number", (*fields)[i + 3])};
    numbers[i] = *number;
  }
  const auto pose =
      pose_of({numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6]});
  if (!pose) return {{}, "quaternion is not of length 1"};
  Shape shape{*kind, static_cast<InstanceId>(*instance),   (*fields)[2],
              *pose, {numbers[7], numbers[8], numbers[9]}, {}};
  if (!has_extent(shape)) return {{}, "a size is not above 0"};
  return {std::move(shape), ""};
}

}  // namespace

std::string shape_table_text(const std::vector<Shape>& shapes) {
  std::string text = std::string(kHeader) + "\n";
  for (const Shape& shape : shapes)
    if (shape.kind != ShapeKind::mesh) text += line_of(shape);
  return text;
}

std::vector<Shape> read_shape_table(const std::filesystem::path& file, std::size_t instance_count) {
  std::istringstream text(read_file(file));
  std::string line;
  if (!std::getline(text, line) || line != kHeader)
    throw Error(
        fmt::format("{}:1: the first line is not '{}'; record again", file.string(), kHeader));
  std::vector<Shape> shapes;
  for (int number = 2; std::getline(text, line); ++number) {
    Parsed parsed = parse(line, instance_count);
    if (!parsed.wrong.empty())
      throw Error(fmt::format("{}:{}: {}; mend the line or record again", file.string(), number,
                              shown(parsed.wrong)));
    shapes.push_back(std::move(parsed.shape));
  }
  return shapes;
}

}  // namespace mapscore::eval
