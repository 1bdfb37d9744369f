// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "eval/lab/runner.hpp"
#include "eval/results/study_store.hpp"
#include "tests/support/plate_recording.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace mapscore::eval::testing {

/// The plate, whose scores are known by hand, with its study in a store.
class SweptPlate : public ::testing::Test {
 protected:
  [[nodiscard]] const std::filesystem::path& results() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path store_file() const { return results() / "results.sqlite"; }

  void sweep(int shard = 1, int shards = 1) const {
    const std::filesystem::path plate = results() / "plate";
    if (!std::filesystem::exists(plate)) mapscore::testing::write_plate_recording(plate);
    const Recording recording = Recording::open(plate);
    const Study study = parse_study(mapscore::testing::kPlateStudy, results() / "study.yaml");
    const ClassTable& table = recording.info().table;
    ResultStore store = ResultStore::open(store_file());
    write_study(store, {study, table, recording.content_hash(), "plate"}, results());
    RunnerOptions options;
    options.shard = shard;
    options.shards = shards;
    run_plan(plan_of(study, recording.content_hash()), recording, table, store, options);
  }

 private:
  mapscore::testing::TemporaryFolder folder_;
};

}  // namespace mapscore::eval::testing
