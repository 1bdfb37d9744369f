// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/suggestion.hpp"

#include "tests/support/expect_error.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mapscore {
namespace {

namespace fs = std::filesystem;

class PathSuggestion : public ::testing::Test {
 protected:
  PathSuggestion() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "results/demo");
    for (const char* name : {"demo.yaml", "home.yaml"}) std::ofstream(folder_ / name) << "x";
  }
  ~PathSuggestion() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string of(const char* missing) const {
    return path_suggestion(folder_ / missing, "give one");
  }
  [[nodiscard]] std::string meant(const char* path) const {
    return "did you mean '" + (folder_ / path).string() + "'?";
  }
  /// Of this process alone: the fixture's tests may run side by side.
  fs::path folder_ =
      fs::temp_directory_path() / ("mapscore_path_suggestion_" + std::to_string(::getpid()));
};

TEST_F(PathSuggestion, IsTheNearestNameAtTheFirstMissingPart) {
  EXPECT_EQ(of("dmeo.yaml"), meant("demo.yaml"));
  EXPECT_EQ(of("demo.yml"), meant("demo.yaml"));
  EXPECT_EQ(of("result/demo/results.sqlite"), meant("results"));
  EXPECT_EQ(of("results/demos"), meant("results/demo"));
  EXPECT_EQ(of("dome.yaml"), meant("home.yaml"));  // by one letter, demo.yaml by two
}

TEST_F(PathSuggestion, IsSilentWhereNothingIsNear) {
  EXPECT_EQ(of("kitchen.yaml"), "give one");
  EXPECT_EQ(of("demo.yaml/study"), "give one") << "below a file";
  EXPECT_EQ(of("results/demo/results.sqlite"), "give one") << "an empty folder";
  EXPECT_EQ(path_suggestion("", "give one"), "give one");
}

TEST(Suggestion, StandsBehindTheProblemOfANameThatIsNotThere) {
  EXPECT_NO_THROW(require_one_of({"direct", "erosion"}, "erosion", "no method"));
  testing::expect_error("no method 'errosion'; did you mean 'erosion'?", [] {
    require_one_of({"direct", "erosion"}, "errosion", "no method 'errosion'");
  });
}

TEST(PathNamed, TakesWholePathsAndEndsThatAreUnique) {
  const std::vector<std::string> paths{"a.x.magnitude_m", "a.y.magnitude_m", "a.y.angle_deg", "y"};
  EXPECT_EQ(path_named("a.x.magnitude_m", paths), paths[0]);
  EXPECT_EQ(path_named("y.magnitude_m", paths), paths[1]);
  EXPECT_EQ(path_named("angle_deg", paths), paths[2]);
  EXPECT_EQ(path_named("y", paths), paths[3]);
  EXPECT_EQ(path_named("magnitude_m", paths), std::nullopt) << "two end so";
  EXPECT_EQ(path_named("le_deg", paths), std::nullopt) << "no whole part";
  EXPECT_EQ(suggestion("magnitude_m", paths), "write one of a.x.magnitude_m, a.y.magnitude_m");
}

}  // namespace
}  // namespace mapscore
