// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/recording/scan_file.hpp"

#include "core/error.hpp"
#include "eval/recording/pose_text.hpp"
#include "files/file_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace mapscore::eval {
namespace {

static_assert(std::endian::native == std::endian::little, "scans.bin is little-endian");

constexpr std::string_view kMagic = "MSSCAN1\n";
constexpr std::size_t kGeometryNumbers = 4 + 7;
constexpr std::size_t kHeaderBytes =
    kMagic.size() + 2 * sizeof(std::uint32_t) + kGeometryNumbers * sizeof(double);

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(fmt::format("{}: {}; record the scans again", file.string(), what));
}

/// Takes values from the front of a file's bytes, whose length was checked.
class Bytes {
 public:
  explicit Bytes(std::string_view rest) : rest_(rest) {}

  template <class T>
  void take(T* values, std::size_t count) {
    std::memcpy(values, rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
  }

 private:
  std::string_view rest_;
};

ScanGeometry geometry_of(const std::filesystem::path& file,
                         const std::array<double, kGeometryNumbers>& numbers) {
  PoseNumbers pose_numbers{};
  std::copy(numbers.begin() + 4, numbers.end(), pose_numbers.begin());
  const auto pose = pose_of(pose_numbers);
  for (const double number : numbers)
    if (!std::isfinite(number)) refuse(file, "a number of its header is not finite");
  if (!pose) refuse(file, "the quaternion of T_base_lidar is not of length 1");
  if (!(numbers[2] >= 0 && numbers[3] > numbers[2]))
    refuse(file, fmt::format("range {} to {} m is none", numbers[2], numbers[3]));
  return {numbers[0], numbers[1], numbers[2], numbers[3], *pose};
}

void check(const std::filesystem::path& file, const ScanLog& log, std::size_t index) {
  const StampedScan& scan = log.scans[index];
  if (!std::isfinite(scan.stamp_s) || (index > 0 && scan.stamp_s <= log.scans[index - 1].stamp_s))
    refuse(file, fmt::format("stamp {} of turn {} does not come after the one before", scan.stamp_s,
                             index));
  for (const float range_m : scan.ranges_m)
    if (!(range_m >= 0.0f)) refuse(file, fmt::format("turn {} holds the range {}", index, range_m));
}

}  // namespace

std::string scan_log_bytes(const ScanLog& log) {
  const std::size_t beams = log.scans.empty() ? 0 : log.scans.front().ranges_m.size();
  const std::uint32_t counts[2] = {static_cast<std::uint32_t>(beams),
                                   static_cast<std::uint32_t>(log.scans.size())};
  const ScanGeometry& g = log.geometry;
  const double geometry[4] = {g.first_angle_rad, g.angle_step_rad, g.range_min_m, g.range_max_m};
  const PoseNumbers pose = numbers_of(g.T_base_lidar);
  std::string bytes(kMagic);
  append(bytes, counts, 2);
  append(bytes, geometry, 4);
  append(bytes, pose.data(), pose.size());
  for (const StampedScan& scan : log.scans) {
    if (scan.ranges_m.size() != beams || beams == 0)
      throw Error("scans: turns differ in their number of beams; give all the same, at least one");
    append(bytes, &scan.stamp_s, 1);
    append(bytes, scan.ranges_m.data(), beams);
  }
  return bytes;
}

ScanLog read_scan_log(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  if (content.size() < kHeaderBytes || !content.starts_with(kMagic))
    refuse(file, "is no scan file of format 1");
  Bytes bytes(std::string_view(content).substr(kMagic.size()));
  std::uint32_t counts[2];
  std::array<double, kGeometryNumbers> numbers{};
  bytes.take(counts, 2);
  bytes.take(numbers.data(), numbers.size());
  const std::uint64_t turn_bytes = sizeof(double) + std::uint64_t{counts[0]} * sizeof(float);
  if (counts[0] == 0 || counts[1] == 0) refuse(file, "holds no scans");
  if ((content.size() - kHeaderBytes) / turn_bytes != counts[1] ||
      (content.size() - kHeaderBytes) % turn_bytes != 0)
    refuse(file, fmt::format("is {} bytes long, not as its header says ({} turns of {} beams)",
                             content.size(), counts[1], counts[0]));
  ScanLog log{geometry_of(file, numbers), {}};
  for (std::uint32_t i = 0; i < counts[1]; ++i) {
    StampedScan& scan = log.scans.emplace_back();
    scan.ranges_m.resize(counts[0]);
    bytes.take(&scan.stamp_s, 1);
    bytes.take(scan.ranges_m.data(), counts[0]);
    check(file, log, i);
  }
  return log;
}

}  // namespace mapscore::eval
