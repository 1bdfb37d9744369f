// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/shape_files.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/csv.hpp"
#include "files/file_bytes.hpp"
#include "files/little_endian.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

namespace mapscore::eval {
namespace {

constexpr const char* kTableHeader = "kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz";
constexpr std::size_t kShapeColumns = 13;
constexpr ShapeKind kKinds[] = {ShapeKind::plane,     ShapeKind::sphere,   ShapeKind::capsule,
                                ShapeKind::ellipsoid, ShapeKind::cylinder, ShapeKind::box};

bool has_extent(const Shape& shape) {
  return (shape.size.head(sizes_of(shape.kind)).array() > 0.0).all() && shape.size.allFinite();
}

std::string line_of(const Shape& shape) {
  const PoseNumbers pose = numbers_of(shape.T_world_shape);
  if (!pose_of(pose) || !has_extent(shape))
    throw Error(fmt::format(
        "geom '{}': pose is not finite or a size not above 0; mend it in the scene", shape.name));
  return fmt::format("{},{},{},{},{},{},{}\n", name_of(shape.kind), shape.instance,
                     csv_cell(shown(shape.name)), join_numbers(pose, ","), shape.size.x(),
                     shape.size.y(), shape.size.z());
}

/// A line of the table, with its place for errors.
struct TableLine {
  const std::filesystem::path& file;
  std::size_t number;
  const std::string& text;

  [[noreturn]] void refuse(const std::string& wrong) const {
    mapscore::refuse(file, number, "{}; mend the line or record again", shown(wrong));
  }
};

Shape shape_of(const TableLine& line, std::size_t instance_count) {
  const auto fields = csv_cells(line.text, kShapeColumns);
  if (!fields || fields->size() != kShapeColumns)
    line.refuse(fmt::format("expected {} columns", kShapeColumns));
  const auto kind = std::ranges::find(kKinds, (*fields)[0], name_of);
  if (kind == std::end(kKinds)) line.refuse(fmt::format("unknown kind '{}'", (*fields)[0]));
  const auto instance = parse_number((*fields)[1]);
  if (!instance || *instance < 0 || *instance >= static_cast<double>(instance_count) ||
      *instance != static_cast<InstanceId>(*instance))
    line.refuse(fmt::format("instance '{}' is not in recording.yaml", (*fields)[1]));
  std::array<double, 10> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parse_number((*fields)[i + 3]);
    if (!number) line.refuse(fmt::format("'{}' is not a finite number", (*fields)[i + 3]));
    numbers[i] = *number;
  }
  PoseNumbers of_pose{};
  std::copy_n(numbers.begin(), of_pose.size(), of_pose.begin());
  const auto pose = pose_of(of_pose);
  if (!pose) line.refuse("quaternion is not of length 1");
  Shape shape{*kind, static_cast<InstanceId>(*instance),   (*fields)[2],
              *pose, {numbers[7], numbers[8], numbers[9]}, {}};
  if (!has_extent(shape)) line.refuse("a size is not above 0");
  return shape;
}

constexpr const char* kStart = "ply\nformat binary_little_endian 1.0\n";
constexpr const char* kVertex = "property double x\nproperty double y\nproperty double z\n";
constexpr const char* kFace =
    "property list uchar int vertex_indices\nproperty ushort instance\nproperty int geom\n";
constexpr std::size_t kVertexBytes = 3 * sizeof(double);
constexpr std::size_t kFaceBytes =
    1 + 3 * sizeof(std::int32_t) + sizeof(InstanceId) + sizeof(std::int32_t);

void check(const Shape& mesh) {
  bool finite = mesh.T_world_shape.matrix().allFinite();
  for (const Triangle& triangle : mesh.triangles)
    for (const Eigen::Vector3d& corner : triangle) finite = finite && corner.allFinite();
  if (!finite || mesh.triangles.empty())
    throw Error(
        fmt::format("mesh '{}': no triangles, or a corner that is not finite; mend it in the scene",
                    mesh.name));
}

/// The header's text, which the counts and names of the meshes fix.
std::string header_of(std::size_t vertices, std::size_t faces,
                      const std::vector<std::string>& names) {
  std::string header = kStart;
  for (const std::string& name : names) header += "comment geom " + name + "\n";
  header += fmt::format("element vertex {}\n{}", vertices, kVertex);
  return header + fmt::format("element face {}\n{}end_header\n", faces, kFace);
}

std::optional<std::string_view> after(std::string_view start, std::string_view line) {
  return line.starts_with(start) ? std::optional(line.substr(start.size())) : std::nullopt;
}

std::size_t leading_count(std::string_view text) {
  std::size_t count = 0;
  std::from_chars(text.data(), text.data() + text.size(), count);
  return count;
}

/// Reads truth/triangles.ply.
class TriangleReader {
 public:
  TriangleReader(const std::filesystem::path& file, std::size_t instance_count)
      : file_(file), instance_count_(instance_count), bytes_(read_file(file)), rest_(bytes_) {}

  std::vector<Shape> read() {
    take_header();
    for (Eigen::Vector3d& vertex : vertices_) {
      for (double& x : vertex) x = take_little_endian<double>(rest_);
      if (!vertex.allFinite()) refuse("a vertex is not finite");
    }
    for (std::size_t face = 0; face < faces_; ++face) take_face();
    for (const Shape& mesh : meshes_)
      if (mesh.triangles.empty()) refuse("a geom has no triangles");
    return std::move(meshes_);
  }

 private:
  [[noreturn]] void refuse(const char* what) const {
    mapscore::refuse(file_, "{}; copy the file anew or record again", what);
  }

  /// Takes counts and names as they stand; then compares the header's text with what they should
  /// give and the file's size with the counts.
  void take_header() {
    std::vector<std::string> names;
    std::size_t vertices = 0;
    std::istringstream text(bytes_.substr(0, bytes_.find("end_header\n")));
    for (std::string line; std::getline(text, line);) {
      if (const auto name = after("comment geom ", line)) names.emplace_back(*name);
      if (const auto count = after("element vertex ", line)) vertices = leading_count(*count);
      if (const auto count = after("element face ", line)) faces_ = leading_count(*count);
    }
    const std::string expected = header_of(vertices, faces_, names);
    if (!bytes_.starts_with(expected)) refuse("not a PLY of triangles as docs/formats.md has it");
    rest_.remove_prefix(expected.size());
    if (vertices > rest_.size() / kVertexBytes || faces_ > rest_.size() / kFaceBytes ||
        rest_.size() != vertices * kVertexBytes + faces_ * kFaceBytes)
      refuse("size does not fit the counts of its header");
    if (names.size() > faces_) refuse("a geom has no triangles");
    vertices_.resize(vertices);
    for (std::string& name : names) {
      meshes_.emplace_back().kind = ShapeKind::mesh;
      meshes_.back().name = std::move(name);
    }
  }

  /// Reads one face and hangs its triangle on its mesh.
  void take_face() {
    if (take_little_endian<std::uint8_t>(rest_) != 3) refuse("a face is not a triangle");
    Triangle triangle;
    for (Eigen::Vector3d& corner : triangle) {
      const auto vertex = static_cast<std::size_t>(take_little_endian<std::int32_t>(rest_));
      if (vertex >= vertices_.size()) refuse("a face names a vertex that is not there");
      corner = vertices_[vertex];
    }
    const auto instance = take_little_endian<InstanceId>(rest_);
    const auto geom = static_cast<std::size_t>(take_little_endian<std::int32_t>(rest_));
    if (geom >= meshes_.size()) refuse("a face names a geom that is not there");
    if (instance >= instance_count_) refuse("a face's instance is not in recording.yaml");
    meshes_[geom].instance = instance;
    meshes_[geom].triangles.push_back(triangle);
  }

  const std::filesystem::path& file_;
  std::size_t instance_count_;
  std::string bytes_;
  std::string_view rest_;
  std::size_t faces_ = 0;
  std::vector<Eigen::Vector3d> vertices_;  ///< world frame
  std::vector<Shape> meshes_;
};

}  // namespace

std::string shape_table_text(const std::vector<Shape>& shapes) {
  std::string text = std::string(kTableHeader) + "\n";
  for (const Shape& shape : shapes)
    if (shape.kind != ShapeKind::mesh) text += line_of(shape);
  return text;
}

std::vector<Shape> read_shape_table(const std::filesystem::path& file, std::size_t instance_count) {
  std::istringstream text(read_file(file));
  std::string line;
  if (!std::getline(text, line) || line != kTableHeader)
    refuse(file, 1, "the first line is not '{}'; record again", kTableHeader);
  std::vector<Shape> shapes;
  for (std::size_t number = 2; std::getline(text, line); ++number)
    shapes.push_back(shape_of({file, number, line}, instance_count));
  return shapes;
}

std::string triangle_ply_bytes(const std::vector<Shape>& shapes) {
  std::vector<std::string> names;
  std::string vertices, faces;
  std::int32_t vertex = 0;
  for (const Shape& shape : shapes) {
    if (shape.kind != ShapeKind::mesh) continue;
    check(shape);
    for (const Triangle& triangle : shape.triangles) {
      append_little_endian(faces, std::uint8_t{3});
      for (const Eigen::Vector3d& p_shape : triangle) {
        const Eigen::Vector3d p_world = shape.T_world_shape * p_shape;
        for (const double x : p_world) append_little_endian(vertices, x);
        append_little_endian(faces, vertex++);
      }
      append_little_endian(faces, shape.instance);
      append_little_endian(faces, static_cast<std::int32_t>(names.size()));
    }
    names.push_back(shown(shape.name));
  }
  if (names.empty()) return "";
  return header_of(vertices.size() / kVertexBytes, faces.size() / kFaceBytes, names) + vertices +
         faces;
}

std::vector<Shape> read_triangle_ply(const std::filesystem::path& file,
                                     std::size_t instance_count) {
  return TriangleReader(file, instance_count).read();
}

}  // namespace mapscore::eval
