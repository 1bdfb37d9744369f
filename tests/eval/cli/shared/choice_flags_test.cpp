// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/cli/shared/choice_flags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;

struct Disc {
  static constexpr std::string_view kKind = "disc", kMeaning = "round";
  int radius_px = 1;
  static void fields(auto& s, auto&& visit) {
    visit(s.radius_px, Field{"radius_px", "radius of the disc", {0, 5}});
  }
};
struct Ring {
  static constexpr std::string_view kKind = "ring", kMeaning = "hollow";
  double radius_px = 2.5, width_px = 1;
  static void fields(auto& s, auto&& visit) {
    visit(s.radius_px, Field{"radius_px", "radius of the ring", {10, 20}});
    visit(s.width_px, Field{"width_px", "of the ring"});
  }
};
using Form = std::variant<Disc, Ring>;

/// The form that a command line chooses. Throws what CLI11 or the flags throw.
Form chosen(const std::string& line) {
  CLI::App verb;
  ChoiceFlags<Form> form{"--form", Disc{}};
  form.add_to(verb);
  verb.parse(line);
  return form.value();
}

std::string refusal(const std::string& line) {
  try {
    (void)chosen(line);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ChoiceFlags, AParameterIsThatOfTheChosenKind) {
  EXPECT_EQ(std::get<Disc>(chosen("--radius_px 4")).radius_px, 4);
  EXPECT_EQ(std::get<Ring>(chosen("--form ring --radius_px 12.5")).radius_px, 12.5);
  EXPECT_EQ(std::get<Ring>(chosen("--form ring --width_px 3")).radius_px, 2.5);
}

TEST(ChoiceFlags, ASharedParameterHasTheRangeOfTheChosenKind) {
  EXPECT_THAT(refusal("--radius_px 12"), HasSubstr("radius_px: 12 is out of range"));
  EXPECT_THAT(refusal("--form ring --radius_px 4"), HasSubstr("radius_px: 4 is out of range"));
  EXPECT_THAT(refusal("--radius_px 7"), HasSubstr("--radius_px: ")) << "for no kind";
}

TEST(ChoiceFlags, AParameterOfAnotherKindIsRefused) {
  EXPECT_EQ(refusal("--width_px 3"), "--width_px: belongs to --form ring; leave it out of disc");
}

TEST(ChoiceFlags, TheHelpOfASharedParameterNamesBothKinds) {
  CLI::App verb;
  ChoiceFlags<Form> form{"--form", Disc{}};
  form.add_to(verb);
  EXPECT_THAT(verb.help(), HasSubstr("Of disc: radius of the disc [1]"));
  EXPECT_THAT(verb.help(), HasSubstr("Of ring: radius of the ring [2.5]"));
}

}  // namespace
}  // namespace mapscore::eval
