// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

namespace mapscore::testing {
namespace {

namespace fs = std::filesystem;

class BadOutput : public TinyStudy {
 protected:
  [[nodiscard]] Outcome sweep(const std::string& into,
                              const Surroundings& surroundings = {}) const {
    return mapscore({"sweep", study(), "-o", into, "-q", "--jobs", "1"}, surroundings);
  }
  [[nodiscard]] std::string tidy(const std::string& of) const {
    const Outcome table = mapscore({"table", of, "--tidy"});
    expect_done(table);
    return table.out;
  }
};

TEST_F(BadOutput, AFileInTheWayOfTheFolder) {
  write_text(path("file"), "mine");
  for (const char* into : {"file", "file/below"})
    expect_refused(sweep(path(into)), {into, "check the folder"});
  expect_refused(mapscore({"truth", path("tiny"), "-o", path("file/t.csv")}),
                 {"file/t.csv", "cannot be written"});
  EXPECT_EQ(bytes_of(path("file")), "mine");
}

TEST_F(BadOutput, AFullDiskForTheStoreLosesOnlyWhatWasNotDone) {
  expect_done(sweep(path("whole")));
  const std::size_t size = fs::file_size(path("whole/results.sqlite"));
  for (const std::size_t room : {std::size_t{5000}, size / 2}) {
    expect_refused(sweep(results(), {.file_size_limit = room, .standard_output = {}}),
                   {"results.sqlite", "check free space"});
    EXPECT_EQ(mapscore({"table", results()}).exit_code, 2);
  }
  expect_done(sweep(results()));
  EXPECT_EQ(tidy(results()), tidy(path("whole")));
}

TEST_F(BadOutput, AFullDiskForFilesKeepsTheOldOnes) {
  expect_done(sweep(results()));
  write_text(path("truth.csv"), "old");
  write_text(path("baseline.json"), "old");
  const auto before = contents_of(folder());
  const Surroundings full{.file_size_limit = 500, .standard_output = {}};
  expect_refused(mapscore({"truth", path("tiny"), "-o", path("truth.csv")}, full),
                 {"truth.csv", "has free space"});
  expect_refused(
      mapscore({"check", results(), "--baseline", path("baseline.json"), "--update"}, full),
      {"baseline.json", "free space"});
  EXPECT_EQ(bytes_of(path("truth.csv")), "old");
  EXPECT_EQ(bytes_of(path("baseline.json")), "old");
  EXPECT_EQ(contents_of(folder()), before);
}

TEST_F(BadOutput, AFullDiskForTheTable) {
  expect_done(sweep(results()));
  const Surroundings full{.file_size_limit = {}, .standard_output = "/dev/full"};
  expect_refused(mapscore({"table", results()}, full), {"standard output cannot be written"});
}

TEST_F(BadOutput, AStoreThatIsNone) {
  fs::create_directories(results());
  write_text(path("results/results.sqlite"), "a letter to grandmother, long enough for a header\n");
  const std::string letter = bytes_of(path("results/results.sqlite"));
  expect_refused(sweep(results()), {"results.sqlite", "that it is a store"});
  expect_refused(mapscore({"table", results()}), {"results.sqlite", "that it is a store"});
  EXPECT_EQ(bytes_of(path("results/results.sqlite")), letter);
}

TEST_F(BadOutput, ATableOfWhatIsNotThere) {
  expect_refused(mapscore({"table", results()}), {"results", "run `mapscore sweep`"});
  EXPECT_EQ(mapscore({"sweep", study(), "-o", results(), "--merge_only"}).exit_code, 1);
  expect_refused(mapscore({"table", results()}), {"trials are not there yet", "mapscore sweep"});
  expect_refused(mapscore({"check", results(), "--baseline", path("b.json"), "--update"}),
                 {"trials are not there yet"});
  EXPECT_FALSE(fs::exists(path("b.json")));
}

TEST_F(BadOutput, ABaselineThatIsMissingOrBroken) {
  expect_done(sweep(results()));
  const auto check = [&] {
    return mapscore({"check", results(), "--baseline", path("baseline.json")});
  };
  expect_refused(check(), {"baseline.json", "--update"});
  for (const char* text :
       {"what,class,metric,value\n", "{}", "[]", "{\"format\": 2}", "{\"format\""}) {
    write_text(path("baseline.json"), text);
    expect_refused(check(), {"baseline.json", "no baseline of this mapscore", "--update"});
  }
}

}  // namespace
}  // namespace mapscore::testing
