// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/onnx_outline.hpp"

#include "files/file_bytes.hpp"
#include "tests/eval/networks/tiny_networks.hpp"

#include <gmock/gmock.h>

namespace mapscore::eval::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

OnnxOutline outline_of(const std::string& name) {
  return read_onnx_outline(read_file(tiny_network(name)), name);
}

TEST(OnnxOutlineOfAFile, HoldsWhatItDeclares) {
  const OnnxOutline crate = outline_of("crate");
  EXPECT_EQ(crate.opset, 11);
  ASSERT_EQ(crate.inputs.size(), 1u);
  EXPECT_EQ(crate.inputs[0].name, "image");
  EXPECT_THAT(crate.inputs[0].shape, ElementsAre(1, 3, 48, 64));
  ASSERT_EQ(crate.outputs.size(), 1u);
  EXPECT_THAT(crate.outputs[0].shape, ElementsAre(1, 3, 48, 64));
  EXPECT_EQ(crate.not_finite, "");
  EXPECT_THAT(outline_of("crate_any_size").inputs[0].shape, ElementsAre(1, 3, -1, -1));
  EXPECT_EQ(outline_of("opset_17").opset, 17);
  EXPECT_EQ(outline_of("nan_weights").not_finite, "kernel");
  EXPECT_EQ(outline_of("two_outputs").outputs.size(), 2u);
  EXPECT_EQ(shape_text({1, 3, -1, 64}), "1 x 3 x ? x 64");
}

/// A message of protocol buffers: a tag with length, and bytes.
std::string field(int number, const std::string& bytes) {
  return std::string{static_cast<char>(number << 3 | 2), static_cast<char>(bytes.size())} + bytes;
}

TEST(OnnxOutlineOfAFile, WeightsAreHeldAgainstNaNAndInfinityInEachType) {
  const auto outline_with = [](int type, const std::string& raw) {
    const int sides = static_cast<int>(raw.size()) / (type == 10 ? 2 : type == 11 ? 8 : 4);
    const std::string tensor =
        std::string{1 << 3, static_cast<char>(sides), 2 << 3, static_cast<char>(type)} +
        field(8, "w") + field(9, raw);
    return read_onnx_outline(field(7, field(5, tensor)), "weights").not_finite;
  };
  const std::string one_half("\x00\x3c", 2), nan_half("\x01\x7e", 2), infinite_half("\x00\xfc", 2);
  EXPECT_EQ(outline_with(10, one_half), "");
  EXPECT_EQ(outline_with(10, one_half + nan_half), "w");
  EXPECT_EQ(outline_with(10, infinite_half), "w");
  EXPECT_EQ(outline_with(1, std::string("\x00\x00\x80\x7f", 4)), "w");
  EXPECT_EQ(outline_with(1, std::string("\x00\x00\x80\x3f", 4)), "");
  EXPECT_EQ(outline_with(11, std::string("\x00\x00\x00\x00\x00\x00\xf0\x7f", 8)), "w");
  EXPECT_EQ(outline_with(6, std::string("\x00\x00\x80\x7f", 4)), "") << "whole numbers";
}

TEST(OnnxOutlineOfAFile, WeightsHoldAsManyNumbersAsTheirSidesSay) {
  const auto said = [](const std::string& sides, const std::string& rest, int graph_field) {
    const std::string tensor = sides + std::string{2 << 3, 1} + field(8, "w") + rest;
    const std::string inside = graph_field == 5 ? tensor : field(5, field(5, tensor));
    return refusal_of(
        [&] { (void)read_onnx_outline(field(7, field(graph_field, inside)), "w.onnx"); });
  };
  const std::string two_by_three{1 << 3, 2, 1 << 3, 3}, packed = field(1, std::string{2, 3});
  const std::string six(24, '\0'), five(20, '\0');
  for (const int graph_field : {5, 1})  // weights of the graph, and of a node
    for (const std::string& sides : {two_by_three, packed}) {
      EXPECT_EQ(said(sides, field(9, six), graph_field), "accepted");
      EXPECT_EQ(said(sides, field(4, six), graph_field), "accepted");
      EXPECT_EQ(said(sides, field(7, std::string{1, 2, 3, 4, 5, '\x80', 1}), graph_field),
                "accepted");
      for (const int numbers : {9, 4})
        EXPECT_THAT(said(sides, field(numbers, five), graph_field),
                    HasSubstr("w.onnx: its weights 'w' are 5 numbers, and their sides say 6"));
      EXPECT_THAT(said(sides, "", graph_field), HasSubstr("are 0 numbers"));
      EXPECT_THAT(said(sides, field(13, "other.bin"), graph_field),
                  HasSubstr("lie in another file"));
    }
  EXPECT_THAT(said(field(1, "\xff\xff\xff\xff\x7f"), "", 5), HasSubstr("more than 4294967296"));
}

TEST(OnnxOutlineOfAFile, OperatorsReadWhatIsGivenBeforeThem) {
  const auto said = [](const std::string& nodes) {
    return refusal_of(
        [&] { (void)read_onnx_outline(field(7, nodes + field(11, field(1, "image"))), "o.onnx"); });
  };
  const std::string first = field(1, field(1, "image") + field(1, "") + field(2, "a"));
  const std::string second = field(1, field(1, "a") + field(2, "b"));
  EXPECT_EQ(said(first + second), "accepted");
  EXPECT_THAT(said(second + first),
              HasSubstr("o.onnx: an operator reads 'a', which nothing before"));
  EXPECT_THAT(said(field(1, field(1, "imagf"))), HasSubstr("reads 'imagf'"));
}

TEST(OnnxOutlineOfAFile, EveryCutEndsInAnErrorOrInAFileWithoutVersion) {
  const std::string bytes = read_file(tiny_network("crate"));
  int refused = 0;
  for (std::size_t count = 0; count < bytes.size(); ++count) {
    const std::string said = refusal_of([&] {
      EXPECT_EQ(read_onnx_outline(bytes.substr(0, count), "cut.onnx").opset, 0) << count;
    });
    if (said == "accepted") continue;
    ++refused;
    EXPECT_THAT(said, HasSubstr("cut.onnx: is no ONNX file, or is cut short"));
  }
  EXPECT_GE(refused, static_cast<int>(bytes.size()) - 4);
}

TEST(OnnxOutlineOfAFile, NoChangedByteLeadsOutOfTheFile) {
  const std::string bytes = read_file(tiny_network("near"));
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const char with : {'\0', '\x7f', '\xff', '\x80', '\x0a'}) {
      std::string changed = bytes;
      changed[at] = with;
      (void)refusal_of([&] { (void)read_onnx_outline(changed, "changed.onnx"); });
    }
}

}  // namespace
}  // namespace mapscore::eval::testing
