// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/plugged.hpp"

#include "core/fusion/fusion_rule.hpp"
#include "core/segmentation/segmentation.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace mapscore {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct AnyScale {
  virtual ~AnyScale() = default;
  [[nodiscard]] virtual double scaled(double number) const = 0;
};
using PluggedScale = Plugged<AnyScale>;

struct Linear {
  static constexpr std::string_view kKind = "linear", kMeaning = "times a factor";
  double factor = 2;
  int offset = 1;
  bool negative = false;
  Degrees turn{90};

  static void fields(auto& s, auto&& visit) {
    visit(s.factor, Field{"factor", "times this", above(0)});
    visit(s.offset, Field{"offset", "plus this"});
    visit(s.negative, Field{"negative", "the sign"});
    visit(s.turn, Field{"turn_deg", "nothing"});
  }
  bool operator==(const Linear&) const = default;
};

struct LinearBox : PluggedBox<AnyScale, Linear, LinearBox> {
  [[nodiscard]] double scaled(double number) const override {
    return (kind_.negative ? -1 : 1) * (kind_.factor * number + kind_.offset);
  }
};

using Scale = std::variant<Linear, PluggedScale>;

/// Adds the kind once for all tests of this file.
class PluggedKind : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    EXPECT_EQ(kinds_of(Scale{}), std::vector<std::string>{"linear"});
    EXPECT_EQ(each_kind<Scale>().size(), 1U);
    EXPECT_THROW((void)*PluggedScale{}, Error);
    EXPECT_NO_THROW(PluggedScale::check("scale"));
    PluggedScale::plug_in("mine", "a scale", std::make_unique<LinearBox>());
  }
};

TEST_F(PluggedKind, IsOneMoreOfTheKinds) {
  EXPECT_EQ(kinds_of(Scale{}), (std::vector<std::string>{"linear", "mine"}));
  ASSERT_EQ(each_kind<Scale>().size(), 2U);
  EXPECT_EQ(kind_of(each_kind<Scale>()[1]), "mine");
}

TEST_F(PluggedKind, HasTheParametersOfItsStruct) {
  PluggedScale scale;
  std::ostringstream text;
  const auto print = [&text]<class T>(const T& member, const Field& field) {
    text << field.key << ' ';
    if constexpr (std::same_as<T, Degrees>)
      text << member.deg << '\n';
    else
      text << member << '\n';
  };
  PluggedScale::fields(scale, [](auto& member, const Field& field) {
    if constexpr (std::same_as<decltype(member), double&>)
      if (field.key == "factor") member = 3;
  });
  PluggedScale::fields(std::as_const(scale), print);
  EXPECT_EQ(text.str(), "factor 3\noffset 1\nnegative 0\nturn_deg 90\n");
  EXPECT_EQ((*scale).scaled(10), 31);
  EXPECT_THAT([&] { check_ranges(scale); }, ::testing::Not(::testing::Throws<Error>()));
}

TEST_F(PluggedKind, CopiesAreDeepAndEqualUntilTheyDiffer) {
  const PluggedScale first;
  PluggedScale second = first;
  EXPECT_EQ(first, second);
  PluggedScale::fields(second, [](auto& member, const Field&) {
    if constexpr (std::same_as<decltype(member), int&>) member = 7;
  });
  EXPECT_NE(first, second);
  EXPECT_EQ((*first).scaled(0), 1);
  EXPECT_EQ((*second).scaled(0), 7);
  second = first;
  EXPECT_EQ(first, second);
}

TEST_F(PluggedKind, AProgramThatDoesNotKnowItsSourceIsRefused) {
  EXPECT_THAT(
      [] { PluggedScale::check("scale"); },
      ThrowsMessage<Error>(HasSubstr("scale 'mine': the program does not know its source")));
  plugged_source = "1234";
  EXPECT_NO_THROW(PluggedScale::check("scale"));
  plugged_source = {};
}

TEST(PluggedTwice, IsRefused) {
  struct Other : AnyScale {};
  using PluggedOther = Plugged<Other>;
  struct Box : PluggedBox<Other, Linear, Box> {
    [[nodiscard]] double scaled(double) const override { return 0; }
  };
  PluggedOther::plug_in("one", "", std::make_unique<Box>());
  PluggedOther::plug_in("two", "", std::make_unique<Box>());
  EXPECT_THAT([] { PluggedOther::check("scale"); },
              ThrowsMessage<Error>(HasSubstr("scale: this program adds two kinds")));
}

TEST(PluggedKinds, NoneInAProgramWithout) {
  EXPECT_EQ(kinds_of(Segmentation{}).size(), std::variant_size_v<Segmentation> - 1);
  EXPECT_EQ(kinds_of(DrawnFusion{}).size(), std::variant_size_v<DrawnFusion> - 1);
}

}  // namespace
}  // namespace mapscore
