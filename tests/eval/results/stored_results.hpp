// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/results/store.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

// What tests of the store share. It lies in a folder of its own for each test.

namespace mapscore::eval::testing {

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A result in which no two numbers are equal.
inline TrialResult result_of(std::int64_t number) {
  const auto next = [&] { return number++; };
  TrialResult result;
  result.counts = zero_counts(2, {});
  for (ClassCounts& c : result.counts) {
    for (auto* count : {&c.predicted, &c.true_predicted, &c.visible, &c.found, &c.false_near,
                        &c.false_leak, &c.false_floating, &c.missed_mislabelled,
                        &c.missed_unlabelled, &c.missed_unmapped, &c.visible_4, &c.found_4})
      *count = next();
    c.at_tolerance = {{1, next(), next()}};
    c.accuracy = DistanceTally({0.01, 0.02});
    c.accuracy.add(0.001 * static_cast<double>(next()));
    c.curve = {next(), next(), {{900, next(), next(), next(), next()}, {7, next(), 0, 0, next()}}};
    c.boxes = {next(), next(), next(), next(), next(), next()};
  }
  Accounting& a = result.accounting;
  for (auto* count : {&a.frames, &a.detections, &a.skipped_no_points, &a.skipped_no_seed_point,
                      &a.skipped_seed_off_object, &a.skipped_eroded_away, &a.points, &a.map_voxels,
                      &a.hits_beyond_span})
    *count = next();
  return result;
}

inline void run_sql(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sql;
  sqlite3_close(database);
}

class StoreTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const char* name) const { return folder_.path() / name; }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

}  // namespace mapscore::eval::testing
