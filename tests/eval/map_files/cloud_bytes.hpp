// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/classes.hpp"
#include "files/file_bytes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace mapscore::testing {

using Points = std::vector<Eigen::Vector3d>;
using Labels = std::vector<std::uint32_t>;

/// A folder of the running test's own; gone with it.
class MapFiles : public ::testing::Test {
 protected:
  MapFiles() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("mapscore_") + test->test_suite_name() + "_" + test->name();
    std::ranges::replace(name, '/', '_');
    folder_ = std::filesystem::path(::testing::TempDir()) / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~MapFiles() override { std::filesystem::remove_all(folder_); }

  /// A file of this name with these bytes.
  std::filesystem::path file(const std::string& name, const std::string& bytes) const {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

/// Appends a number as it lies in memory, or in the other byte order.
template <class Number>
void put(std::string& bytes, Number number, bool swapped = false) {
  std::string own(sizeof(Number), '\0');
  std::memcpy(own.data(), &number, sizeof(Number));
  if (swapped) std::ranges::reverse(own);
  bytes += own;
}

/// background, cup (FF0000), chair (0000FF), sofa (0000FF as well).
inline ClassTable household() {
  ClassTable table;
  table.classes.push_back({1, "cup", {255, 0, 0}, true});
  table.classes.push_back({2, "chair", {0, 0, 255}, true});
  table.classes.push_back({3, "sofa", {0, 0, 255}, true});
  return table;
}

}  // namespace mapscore::testing
