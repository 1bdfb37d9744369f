// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/study/picture_view.hpp"

#include "core/error.hpp"
#include "eval/results/plan.hpp"
#include "tests/eval/lab/tiny_experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;
using testing::study_of;

TEST(PictureView, IsEyeTargetAndPerhapsAnAngle) {
  const sim::View view = view_of_numbers(std::vector<double>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(view.eye_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(view.target_m, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(view.vfov_deg, 45.0);
  EXPECT_EQ(view_of_numbers(std::vector<double>{0, 0, 5, 0, 0, 0, 70}).vfov_deg, 70.0);
}

TEST(PictureView, RefusesWhatCannotBeLookedAt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& numbers :
       std::vector<std::vector<double>>{{},
                                        {1, 2, 3, 4, 5},
                                        {1, 2, 3, 4, 5, 6, 45, 1},
                                        {1, 2, 3, 1, 2, 3},
                                        {1, 2, 3, 1, 2, 3.0005},
                                        {nan, 2, 3, 4, 5, 6},
                                        {1, 2, 3, 4, 5, infinity},
                                        {1, 2, 3, 4, 5, 6, nan},
                                        {1, 2, 3, 4, 5, 6, 0},
                                        {1, 2, 3, 4, 5, 6, 180},
                                        {1e7, 2, 3, 4, 5, 6}})
    EXPECT_THROW((void)view_of_numbers(numbers), Error) << ::testing::PrintToString(numbers);
}

TEST(PictureView, OfAStudyChangesNoTrial) {
  const Study plain = study_of("");
  const Study viewed = study_of("picture_view: [0, 0, 5, 0, 0, 0]\n");
  EXPECT_TRUE(viewed.picture_view);
  EXPECT_EQ(plan_of(plain, "recording").tasks[0].key, plan_of(viewed, "recording").tasks[0].key);
  EXPECT_EQ(parse_study(to_yaml(viewed), viewed.base_folder / "again.yaml").picture_view,
            viewed.picture_view);
}

TEST(PictureView, OfAStudyIsCheckedWhenItIsRead) {
  const auto message = [](const std::string& text) {
    try {
      (void)study_of(text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("picture_view: [0, 0, 5, 0, 0, 5]\n"), HasSubstr("picture_view: eye and"));
  EXPECT_THAT(message("picture_view: [0, 0, 5]\n"), HasSubstr("picture_view: a view of 3 numbers"));
  EXPECT_THAT(message("sweep: {picture_view: [[0, 0, 5, 0, 0, 0]]}\n"),
              HasSubstr("cannot be swept"));
}

}  // namespace
}  // namespace mapscore::eval
