// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "files/yaml_value.hpp"

#include "files/file_bytes.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gtest/gtest.h>

namespace mapscore {
namespace {

using testing::expect_error;

/// Plain words are read without the parser.
TEST(YamlValueOfAFlag, IsWhatTheParserReads) {
  for (const char* text :
       {"0.05", "1e-05", "walk", "a/b.txt", "true", "..", "0x1F", "-0.5", "-.inf", "null", "Null",
        "~", "\"0.05\"", "'a'", "[1, 2]", "a b", "1."}) {
    const YAML::Node parsed = YAML::Load(text), read = parse_yaml_value(text, "", "").node;
    EXPECT_EQ(read.Type(), parsed.Type()) << text;
    EXPECT_EQ(read.Tag() == "!", parsed.Tag() == "!") << text;
    EXPECT_EQ(read.Scalar(), parsed.Scalar()) << text;
  }
}

TEST(YamlValue, LinesAreThoseOfKeysInEntriesAndElseOfValues) {
  const YamlValue root = parse_yaml("a:\n  b:\n    3\nlist:\n  - x\n", "f");
  EXPECT_EQ(root.at("a").at("b").line, 3);
  EXPECT_EQ(root.at("a").entries()[0].second.line, 2);
  EXPECT_EQ(root.at("list").elements()[0].line, 5);
  EXPECT_EQ(root.at("a").at("b").path, "a.b");
  EXPECT_EQ(root.at("list").elements()[0].path, "list[0]");
  EXPECT_EQ(parse_yaml_value("{b: 3}", "--flag", "a").at("b").line, 0);
}

TEST(YamlValue, SaysWhatStandsThereAndWhatToWrite) {
  const YamlValue root = parse_yaml("a: [1]\nb: yes\nc: 1.5\nd: \"\"\ne: ~\n", "f");
  expect_error("f:1: a: is a list; write a text", [&] { (void)root.at("a").text(); });
  expect_error("f:1: a: is a list; write a section, key: value",
               [&] { (void)root.at("a").at("x"); });
  expect_error("f:2: b: is yes; write true or false", [&] { (void)root.at("b").boolean(); });
  expect_error("f:2: b: is yes; write a finite number", [&] { (void)root.at("b").number(); });
  expect_error("f:3: c: is 1.5; write a whole number from 0 to 9",
               [&] { (void)root.at("c").whole(0, 9); });
  expect_error("f:4: d: is empty; write a name", [&] { (void)root.at("d").name(); });
  expect_error("f:5: e: has no value; write six hexadecimal digits in quotes, like \"FF0000\"",
               [&] { (void)root.at("e").colour(); });
  expect_error("f:1: 'g' is missing; write g: ...", [&] { (void)root.at("g"); });
  expect_error("f:4: d: unknown key 'd'; remove it",
               [&] { parse_yaml("\n\n\nd: 1\n", "f").only({}); });
  EXPECT_TRUE(root.has("e"));
  EXPECT_FALSE(root.has("g"));
  EXPECT_FALSE(root.at("a").has("g"));
}

TEST(YamlValue, NothingRawReachesAMessage) {
  const YamlValue root = parse_yaml("\"a\\n\\u202e\": \"\\u2028\\e\"\n", "f\x1b");
  expect_error("f\\x1b:1: a\\n\\u202e: unknown key 'a\\n\\u202e'; write one of x, y", [&] {
    root.only({"x", "y"});
  });
  expect_error("is \"\\u2028\\x1b\"; write true or false",
               [&] { (void)root.entries()[0].second.boolean(); });
}

TEST(YamlFile, IsReadStrictly) {
  const testing::TemporaryFolder folder;
  const auto expect_refusal = [&](const std::string& text, const std::string& part) {
    write_file(folder.path() / "a.yaml", text);
    expect_error("a.yaml:" + part, [&] { (void)load_yaml(folder.path() / "a.yaml"); });
  };
  expect_refusal("", "1: the file is empty");
  expect_refusal("\n- 1\n", "2: is a list; write a section");
  expect_refusal("a:\n\tb: 1\n", "2: a tab indents this line");
  expect_refusal("a: 1\nb: \x07\n", "2: control character 0x07");
  expect_refusal("a: 1\n---\nb: 1\n", "2: a second document begins");
  expect_refusal("a: [1\nb: ]\n", "2: not YAML: ");
  expect_refusal("a: 1\na: [" + std::string(1 << 19, ',') + "]\n", " more than 524288 values");
  write_file(folder.path() / "a.yaml", "---\r\na:\t1  # one\r\n...\r\n");
  EXPECT_EQ(load_yaml(folder.path() / "a.yaml").at("a").whole(1, 1), 1u);
}

}  // namespace
}  // namespace mapscore
