// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/results/searched_trials.hpp"

#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

namespace mapscore::eval {
namespace {

using mapscore::testing::expect_error;
using mapscore::testing::TemporaryFolder;

TEST(SearchedTrials, AreKeptOnceInTheOrderOfAsking) {
  const TemporaryFolder folder;
  ResultStore store = ResultStore::open(folder.path() / "results.sqlite");
  EXPECT_TRUE(searched_trials(store).empty());
  const SearchedTrial first{"b", {0, "direct", {0, {{"faults.a", "0.1"}, {"faults.b", "x y"}}}, 3}};
  const SearchedTrial second{"a", {0, "erosion", {0, {{"faults.a", "0"}}}, 0}};
  note_searched(store, {first, first});
  note_searched(store, {second, first});
  EXPECT_EQ(searched_trials(store), (std::vector{first, second}));
  for (const char* damaged : {"[", "[[1]]", R"([["k", "m", 0, [["a"]]]])", "3"}) {
    store.set_text("searched", damaged);
    expect_error("list of searched trials is not readable", [&] { (void)searched_trials(store); });
  }
}

}  // namespace
}  // namespace mapscore::eval
