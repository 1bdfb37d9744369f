// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/scan_file.hpp"

#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"
#include "files/little_endian.hpp"
#include "files/refusal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mapscore::eval {
namespace {

constexpr std::string_view kMagic = "MSSCAN1\n";
constexpr std::size_t kGeometryNumbers = 4 + 7;
constexpr std::size_t kHeaderBytes =
    kMagic.size() + 2 * sizeof(std::uint32_t) + kGeometryNumbers * sizeof(double);

[[noreturn]] void refuse_scans(const std::filesystem::path& file, const std::string& what) {
  refuse(file, "{}; record the scans again", what);
}

ScanGeometry geometry_of(const std::filesystem::path& file,
                         const std::array<double, kGeometryNumbers>& numbers) {
  PoseNumbers pose_numbers{};
  std::copy(numbers.begin() + 4, numbers.end(), pose_numbers.begin());
  const auto pose = pose_of(pose_numbers);
  for (const double number : numbers)
    if (!std::isfinite(number)) refuse_scans(file, "a number of its header is not finite");
  if (!pose) refuse_scans(file, "the quaternion of T_base_lidar is not of length 1");
  if (!(numbers[2] >= 0 && numbers[3] > numbers[2]))
    refuse_scans(file, fmt::format("range {} to {} m is none", numbers[2], numbers[3]));
  return {numbers[0], numbers[1], numbers[2], numbers[3], *pose};
}

void check(const std::filesystem::path& file, const ScanLog& log, std::size_t index) {
  const StampedScan& scan = log.scans[index];
  if (!std::isfinite(scan.stamp_s) || (index > 0 && scan.stamp_s <= log.scans[index - 1].stamp_s))
    refuse_scans(file, fmt::format("stamp {} of turn {} does not come after the one before",
                                   scan.stamp_s, index));
  for (const float range_m : scan.ranges_m)
    if (!(range_m >= 0.0f))
      refuse_scans(file, fmt::format("turn {} holds the range {}", index, range_m));
}

}  // namespace

std::string scan_log_bytes(const ScanLog& log) {
  const std::size_t beams = log.scans.empty() ? 0 : log.scans.front().ranges_m.size();
  const ScanGeometry& g = log.geometry;
  std::string bytes(kMagic);
  append_little_endian(bytes, static_cast<std::uint32_t>(beams));
  append_little_endian(bytes, static_cast<std::uint32_t>(log.scans.size()));
  for (const double number : {g.first_angle_rad, g.angle_step_rad, g.range_min_m, g.range_max_m})
    append_little_endian(bytes, number);
  for (const double number : numbers_of(g.T_base_lidar)) append_little_endian(bytes, number);
  for (const StampedScan& scan : log.scans) {
    if (scan.ranges_m.size() != beams || beams == 0)
      throw Error("scans: turns differ in their number of beams; give all the same, at least one");
    append_little_endian(bytes, scan.stamp_s);
    for (const float range_m : scan.ranges_m) append_little_endian(bytes, range_m);
  }
  return bytes;
}

ScanLog read_scan_log(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  if (content.size() < kHeaderBytes || !content.starts_with(kMagic))
    refuse_scans(file, "is no scan file of format 1");
  std::string_view rest = std::string_view(content).substr(kMagic.size());
  const auto beams = take_little_endian<std::uint32_t>(rest);
  const auto turns = take_little_endian<std::uint32_t>(rest);
  std::array<double, kGeometryNumbers> numbers{};
  for (double& number : numbers) number = take_little_endian<double>(rest);
  const std::uint64_t turn_bytes = sizeof(double) + std::uint64_t{beams} * sizeof(float);
  if (beams == 0 || turns == 0) refuse_scans(file, "holds no scans");
  if (rest.size() / turn_bytes != turns || rest.size() % turn_bytes != 0)
    refuse_scans(file,
                 fmt::format("is {} bytes long, not as its header says ({} turns of {} beams)",
                             content.size(), turns, beams));
  ScanLog log{geometry_of(file, numbers), {}};
  for (std::uint32_t i = 0; i < turns; ++i) {
    StampedScan& scan = log.scans.emplace_back();
    scan.stamp_s = take_little_endian<double>(rest);
    scan.ranges_m.resize(beams);
    for (float& range_m : scan.ranges_m) range_m = take_little_endian<float>(rest);
    check(file, log, i);
  }
  return log;
}

}  // namespace mapscore::eval
