// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/map_files/map_transform.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/refusal.hpp"
#include "files/text.hpp"
#include "files/text_rows.hpp"

#include <algorithm>
#include <vector>

namespace mapscore::eval {
namespace {

constexpr double kOrthonormal = 1e-6;
/// Below this a matrix is taken as it stands, so that turns by right angles stay exact.
constexpr double kRounding = 1e-12;

std::vector<double> numbers_in(std::string_view text, const std::string& where) {
  std::vector<double> numbers;
  const bool one_line = text.find('\n') == text.npos;
  TextLines lines(text);
  while (const auto line = lines.next()) {
    std::string plain(line->substr(0, line->find('#')));
    std::ranges::replace(plain, ',', ' ');
    std::vector<std::string_view> words;
    if (!TextLines(plain).next_words(words)) continue;
    for (const std::string_view word : words) {
      const auto number = parse_number(word);
      if (!number)
        refuse(one_line ? where : fmt::format("{}:{}", where, lines.number()),
               "{} is no finite number; mend the transform", excerpt(word));
      numbers.push_back(*number);
    }
  }
  return numbers;
}

Pose pose_of_matrix(const std::vector<double>& numbers, const std::string& where) {
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d matrix = Eigen::Map<const RowMajor>(numbers.data());
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    refuse(where, "the last row of the matrix is not 0 0 0 1; write it row by row");
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double off =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kOrthonormal))
    refuse(where,
           "the rotation is off orthonormal by {:.2g}; scale and shear are no rigid transform",
           off);
  if (rotation.determinant() < 0.0)
    refuse(where, "the rotation is a reflection; mirror the map first");
  Pose pose = Pose::Identity();
  pose.linear() =
      off <= kRounding ? rotation : Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace

Pose parse_transform(std::string_view text, const std::string& where) {
  const std::vector<double> numbers = numbers_in(text, where);
  if (numbers.size() == 16) return pose_of_matrix(numbers, where);
  if (numbers.size() != 7 && numbers.size() != 8)
    refuse(where,
           "a transform has 7 numbers (tx ty tz qx qy qz qw), 8 with a stamp ahead, or 16 of a "
           "matrix; these are {}",
           numbers.size());
  PoseNumbers of_pose{};
  std::copy(numbers.end() - 7, numbers.end(), of_pose.begin());
  const auto pose = pose_of(of_pose);
  if (!pose) refuse(where, "quaternion qx qy qz qw is not of length 1; normalise it");
  return *pose;
}

Pose read_transform(const std::filesystem::path& file) {
  return parse_transform(read_file(file), file.string());
}

}  // namespace mapscore::eval
