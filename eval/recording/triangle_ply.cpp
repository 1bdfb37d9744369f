// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/triangle_ply.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/little_endian.hpp"
#include "files/text.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <sstream>

namespace mapscore::eval {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the file is written as it lies in memory");

constexpr const char* kStart = "ply\nformat binary_little_endian 1.0\n";
constexpr const char* kVertex = "property double x\nproperty double y\nproperty double z\n";
constexpr const char* kFace =
    "property list uchar int vertex_indices\nproperty ushort instance\nproperty int geom\n";
constexpr std::size_t kVertexBytes = 3 * sizeof(double);
constexpr std::size_t kFaceBytes =
    1 + 3 * sizeof(std::int32_t) + sizeof(InstanceId) + sizeof(std::int32_t);

template <class T>
T take(const char*& from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  from += sizeof(T);
  return value;
}

void check(const Shape& mesh) {
  bool finite = mesh.T_world_shape.matrix().allFinite();
  for (const Triangle& triangle : mesh.triangles)
    for (const Eigen::Vector3d& corner : triangle) finite = finite && corner.allFinite();
  if (!finite || mesh.triangles.empty())
    throw Error(
        fmt::format("mesh '{}': no triangles, or a corner that is not finite; mend it in the "
                    "scene",
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

struct Header {
  std::size_t vertices = 0, faces = 0;
  std::vector<std::string> names;
  std::size_t bytes = 0;  ///< length of the header itself
};

std::size_t count_after(const std::string& line, std::string_view prefix) {
  std::size_t count = 0;
  std::from_chars(line.data() + prefix.size(), line.data() + line.size(), count);
  return count;
}

/// Counts and names as they stand, unchecked.
Header parse_header(const std::string& bytes) {
  constexpr std::string_view kGeom = "comment geom ", kVertices = "element vertex ",
                             kFaces = "element face ";
  Header header;
  std::istringstream text(bytes.substr(0, bytes.find("end_header\n")));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(kGeom)) header.names.push_back(line.substr(kGeom.size()));
    if (line.starts_with(kVertices)) header.vertices = count_after(line, kVertices);
    if (line.starts_with(kFaces)) header.faces = count_after(line, kFaces);
  }
  return header;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(fmt::format("{}: {}; copy the file anew or record again", file.string(), what));
}

/// Counts and names, after comparing the header's text with what they should give and the file's
/// size with the counts.
Header checked_header(const std::string& bytes, const std::filesystem::path& file) {
  Header header = parse_header(bytes);
  const std::string expected = header_of(header.vertices, header.faces, header.names);
  if (!bytes.starts_with(expected))
    refuse(file, "not a PLY of triangles as docs/formats.md has it");
  header.bytes = expected.size();
  const std::size_t body = bytes.size() - header.bytes;
  if (header.vertices > body / kVertexBytes || header.faces > body / kFaceBytes ||
      body != header.vertices * kVertexBytes + header.faces * kFaceBytes)
    refuse(file, "size does not fit the counts of its header");
  if (header.names.size() > header.faces) refuse(file, "a geom has no triangles");
  return header;
}

std::vector<Eigen::Vector3d> take_vertices(const char*& from, std::size_t count,
                                           const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> vertices(count);
  for (Eigen::Vector3d& vertex : vertices) {
    for (int axis = 0; axis < 3; ++axis) vertex[axis] = take<double>(from);
    if (!vertex.allFinite()) refuse(file, "a vertex is not finite");
  }
  return vertices;
}

/// Reads one face and hangs its triangle on its mesh.
void take_face(const char*& from, const std::vector<Eigen::Vector3d>& vertices,
               std::size_t instance_count, std::vector<Shape>& meshes,
               const std::filesystem::path& file) {
  if (take<std::uint8_t>(from) != 3) refuse(file, "a face is not a triangle");
  Triangle triangle;
  for (Eigen::Vector3d& corner : triangle) {
    const auto vertex = static_cast<std::size_t>(take<std::int32_t>(from));
    if (vertex >= vertices.size()) refuse(file, "a face names a vertex that is not there");
    corner = vertices[vertex];
  }
  const auto instance = take<InstanceId>(from);
  const auto geom = static_cast<std::size_t>(take<std::int32_t>(from));
  if (geom >= meshes.size()) refuse(file, "a face names a geom that is not there");
  if (instance >= instance_count) refuse(file, "a face's instance is not in recording.yaml");
  meshes[geom].instance = instance;
  meshes[geom].triangles.push_back(triangle);
}

}  // namespace

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
        for (int axis = 0; axis < 3; ++axis) append_little_endian(vertices, p_world[axis]);
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
  const std::string bytes = read_file(file);
  const Header header = checked_header(bytes, file);
  const char* from = bytes.data() + header.bytes;
  const std::vector<Eigen::Vector3d> p_world = take_vertices(from, header.vertices, file);
  std::vector<Shape> meshes(header.names.size());
  for (std::size_t face = 0; face < header.faces; ++face)
    take_face(from, p_world, instance_count, meshes, file);
  for (std::size_t geom = 0; geom < meshes.size(); ++geom) {
    meshes[geom].kind = ShapeKind::mesh;
    meshes[geom].name = header.names[geom];
    if (meshes[geom].triangles.empty()) refuse(file, "a geom has no triangles");
  }
  return meshes;
}

}  // namespace mapscore::eval
