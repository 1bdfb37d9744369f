// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/text.hpp"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

#include <random>

namespace mapscore {
namespace {

using ::testing::HasSubstr;

const std::string kLongest(255, 'n');

TEST(UnfitAsName, PlainNamesOfAnyScriptAreFit) {
  for (const std::string& name :
       {std::string("cup"), std::string("`touch x`"), std::string("$(id)"),
        std::string("a \"b\" 'c'"), std::string("=1+1"), std::string("чашка"), std::string("茶碗"),
        std::string("☕👩‍👦"), std::string("../up"), std::string("</script>"),
        std::string("50%"), kLongest})
    EXPECT_EQ(unfit_as_name(name), std::nullopt) << name;
}

TEST(UnfitAsName, SaysWhatIsWrong) {
  const auto why = [](std::string_view name) { return unfit_as_name(name).value_or("fit"); };
  EXPECT_THAT(why(""), HasSubstr("is empty"));
  EXPECT_THAT(why(kLongest + kLongest), HasSubstr("510 bytes"));
  EXPECT_THAT(why("a\nb"), HasSubstr("control character \\n"));
  EXPECT_THAT(why("\x1b[2J"), HasSubstr("control character \\x1b"));
  EXPECT_THAT(why(std::string_view("a\0b", 3)), HasSubstr("\\x00"));
  EXPECT_THAT(why("\x7f"), HasSubstr("\\x7f"));
  EXPECT_THAT(why("\xc2\x9b"), HasSubstr("control character \\x9b"));
  EXPECT_THAT(why("a\xe2\x80\xae"
                  "b"),
              HasSubstr("invisible character \\u202e"));
  EXPECT_THAT(why("a\xe2\x80\xa8"
                  "b"),
              HasSubstr("\\u2028"));
  EXPECT_THAT(why("\xff"), HasSubstr("not UTF-8"));
}

TEST(Shown, KeepsWhatATerminalOnlyPrints) {
  EXPECT_EQ(shown("chair `x` \"y\" 50 % σ ×"), "chair `x` \"y\" 50 % σ ×");
  EXPECT_EQ(shown(std::filesystem::path("a/b")), "a/b");
}

TEST(Shown, EscapesWhatATerminalObeys) {
  EXPECT_EQ(shown("a\nb\tc\rd\x1b]0;t\x07"), "a\\nb\\tc\\rd\\x1b]0;t\\x07");
  EXPECT_EQ(shown("\xe2\x80\xae\xc2\x85\xf3\xa0\x81\x81"), "\\u202e\\x85\\U000e0041");
  EXPECT_EQ(shown_lines("a\n\tb\x1b"), "a\n\tb\\x1b");
}

TEST(Shown, EscapesEachByteThatIsNoUtf8) {
  EXPECT_EQ(shown("a\xff\xc3(\xe2\x82"), "a\\xff\\xc3(\\xe2\\x82");
  EXPECT_EQ(shown("\xc0\x80"), "\\xc0\\x80") << "longer than it need be";
  EXPECT_EQ(shown("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(shown("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last code point";
}

TEST(Shown, LeavesNothingToObeyOfAnyBytes) {
  std::mt19937 random(1);
  for (int turn = 0; turn < 2000; ++turn) {
    std::string bytes(random() % 24, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string text = shown(bytes);
    EXPECT_EQ(shown(text), text) << "what is shown stays as it is";
    EXPECT_EQ(text.find_first_of("\n\r\t\x1b\x07\x7f"), text.npos);
    EXPECT_EQ(unfinished_tail(text), 0u);
  }
}

TEST(UnfinishedTail, CountsTheBytesOfACharacterThatHasBegun) {
  const std::string cup = "\xf0\x9f\x8d\xb5";
  for (std::size_t bytes = 0; bytes < 4; ++bytes)
    EXPECT_EQ(unfinished_tail(cup + cup.substr(0, bytes)), bytes);
  EXPECT_EQ(unfinished_tail(cup + cup), 0u);
  EXPECT_EQ(unfinished_tail("\xff"), 0u);
}

TEST(YamlQuoted, IsReadBackAsItWas) {
  for (const std::string text :
       {"cup", "a: b # c", "\"q\" \\ 'p'", "*a &b !c", "x\ny\tz", "σ ☕", ""})
    EXPECT_EQ(YAML::Load("k: " + yaml_quoted(text))["k"].as<std::string>(), text);
}

TEST(YamlQuoted, HoldsWhatEveryReaderTakes) {
  EXPECT_EQ(yaml_quoted("a\xc2\x9b\x1b\x7f"), "\"a\\x9b\\x1b\\x7f\"");
  EXPECT_EQ(yaml_quoted("a\xff"), "\"a\xef\xbf\xbd\"");
}

TEST(XmlQuoted, HoldsNoMarkup) {
  EXPECT_EQ(xml_quoted("<a b=\"c\">&\n\xff"), "\"&lt;a b=&quot;c&quot;&gt;&amp;__\"");
}

TEST(GnuplotQuoted, StandsBetweenSingleQuotes) {
  EXPECT_EQ(gnuplot_quoted("`x` $(y) \"z\" \\n @m"), "'`x` $(y) \"z\" \\n @m'");
  EXPECT_EQ(gnuplot_quoted("it's"), "'it'.\"'\".'s'");
  EXPECT_EQ(gnuplot_quoted("two\nlines\x1b"), "'two'.\"\\n\".'lines\\x1b'");
  EXPECT_EQ(gnuplot_column("a \"b\"\n`c`"), "\"a 'b'\\n`c`\"");
}

TEST(ShellWord, IsOneWordWhateverItHolds) {
  EXPECT_EQ(shell_word("results/demo-1.ot"), "results/demo-1.ot");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("$(id) `id` it's"), "'$(id) `id` it'\\''s'");
}

}  // namespace
}  // namespace mapscore
