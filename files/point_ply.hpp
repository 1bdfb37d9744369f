// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "files/little_endian.hpp"

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>

namespace mapscore {

/// Writer of a binary little-endian PLY of points: float32 x, y, z, then further properties.
class PointPly {
 public:
  /// `properties`: type and name of each further property, such as "uint label". `comment` may be
  /// empty.
  PointPly(std::size_t count, std::initializer_list<std::string_view> properties,
           std::string_view comment = {}) {
    bytes_ = "ply\nformat binary_little_endian 1.0\n";
    if (!comment.empty()) bytes_.append("comment ").append(comment).append("\n");
    bytes_ += "element vertex " + std::to_string(count) + "\n";
    for (const std::string_view axis : {"float x", "float y", "float z"}) declare(axis);
    for (const std::string_view property : properties) declare(property);
    bytes_ += "end_header\n";
    header_bytes_ = bytes_.size();
  }

  /// Appends a point; `values` are of the properties' types, in their order.
  void add(const Eigen::Vector3d& point, auto... values) {
    for (const double x : point) append_little_endian(bytes_, static_cast<float>(x));
    (append_little_endian(bytes_, values), ...);
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t header_bytes() const { return header_bytes_; }

 private:
  void declare(std::string_view property) {
    bytes_.append("property ").append(property).append("\n");
  }

  std::string bytes_;
  std::size_t header_bytes_ = 0;
};

}  // namespace mapscore
