// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/networks/segmentation_network.hpp"

#include "files/file_bytes.hpp"
#include "tests/eval/networks/tiny_networks.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace mapscore::eval::testing {
namespace {

using ::testing::HasSubstr;

const cv::Size kTiny(64, 48);

/// Values of a plane, row by row.
using Plane = std::vector<std::vector<double>>;

cv::Mat3b random_colours(unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat3b image(kTiny);
  for (cv::Vec3b& pixel : image)
    for (int channel = 0; channel < 3; ++channel)
      pixel[channel] = static_cast<std::uint8_t>(random() % 256);
  return image;
}

/// What tests/network/make_models.py writes as crate.onnx, in words: red, green, blue in.
std::vector<double> crate_logits(double red, double green, double blue) {
  return {1.0, 0.01 * red - 0.01 * green, 0.01 * blue - 0.01 * green};
}

/// Checks labels and probabilities against logits by pixel; where two of them are as good as equal
/// the label may be either.
void expect_segmented(const Segmented& segmented, const auto& logits_at) {
  ASSERT_EQ(segmented.label.size(), kTiny);
  for (int v = 0; v < kTiny.height; ++v)
    for (int u = 0; u < kTiny.width; ++u) {
      const std::vector<double> logits = logits_at(u, v);
      const double most = *std::ranges::max_element(logits);
      double sum = 0;
      for (const double logit : logits) sum += std::exp(logit - most);
      const std::uint16_t label = segmented.label(v, u);
      ASSERT_LT(label, logits.size());
      ASSERT_NEAR(logits[label], most, 1e-5) << u << ' ' << v;
      ASSERT_NEAR(segmented.probability(v, u), 1.0 / sum, 1e-5) << u << ' ' << v;
    }
}

TEST(SegmentationNetworkOfAFile, GivesTheSoftmaxOfItsConvolution) {
  const cv::Mat3b image = random_colours(1);
  SegmentationNetwork network({tiny_network("crate"), {}}, kTiny);
  EXPECT_EQ(network.class_count(), 3);
  EXPECT_FALSE(network.needs_depth());
  expect_segmented(network.segment(image, {}, "image"), [&](int u, int v) {
    return crate_logits(image(v, u)[2], image(v, u)[1], image(v, u)[0]);
  });
}

TEST(SegmentationNetworkOfAFile, TakesColoursAsItIsTold) {
  const cv::Mat3b image = random_colours(2);
  SegmentationNetwork network({.model = tiny_network("crate"),
                               .classes = {},
                               .channels = ChannelOrder::bgr,
                               .scale = 2,
                               .mean = {10, 20, 30},
                               .std = {1, 0.5, 2}},
                              kTiny);
  expect_segmented(network.segment(image, {}, "image"), [&](int u, int v) {
    return crate_logits(2.0 * image(v, u)[0] - 10, (2.0 * image(v, u)[1] - 20) / 0.5,
                        (2.0 * image(v, u)[2] - 30) / 2);
  });
}

TEST(SegmentationNetworkOfAFile, TakesDepthInMetresAsItsFourthChannel) {
  const cv::Mat3b image = random_colours(3);
  cv::Mat1f depth_m(kTiny);
  for (int v = 0; v < kTiny.height; ++v)
    for (int u = 0; u < kTiny.width; ++u) depth_m(v, u) = u < 20 ? 0.0F : u < 40 ? 1.5F : 3.0F;
  SegmentationNetwork network({tiny_network("near"), {}}, kTiny);
  EXPECT_TRUE(network.needs_depth());
  const cv::Mat1f kept = depth_m.clone();
  const Segmented segmented = network.segment(image, depth_m, "image");
  EXPECT_EQ(cv::countNonZero(depth_m != kept), 0) << "written over";
  expect_segmented(segmented, [&](int u, int v) {
    const double z = static_cast<double>(kept(v, u));
    return std::vector{2 - 8 * z, 2 - z, z - 2};
  });
}

TEST(SegmentationNetworkOfAFile, OpenSidesTakeTheSizeOfTheImage) {
  const cv::Mat3b image = random_colours(4);
  SegmentationNetwork fixed({tiny_network("crate"), {}}, kTiny);
  SegmentationNetwork open({tiny_network("crate_any_size"), {}}, kTiny);
  EXPECT_EQ(open.input_size(), kTiny);
  const Segmented a = fixed.segment(image, {}, ""), b = open.segment(image, {}, "");
  EXPECT_EQ(cv::countNonZero(a.label != b.label), 0);
  EXPECT_EQ(cv::countNonZero(a.probability != b.probability), 0);
}

/// Bilinear, pixel centres at (u + 1/2) / width, the border repeated.
Plane plainly_resized(const Plane& from, int width, int height) {
  const auto rows = static_cast<int>(from.size()), columns = static_cast<int>(from[0].size());
  const auto at = [&](int u, int v) {
    return from[static_cast<std::size_t>(std::clamp(v, 0, rows - 1))]
               [static_cast<std::size_t>(std::clamp(u, 0, columns - 1))];
  };
  Plane to(static_cast<std::size_t>(height), std::vector<double>(static_cast<std::size_t>(width)));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double x = (u + 0.5) * columns / width - 0.5, y = (v + 0.5) * rows / height - 0.5;
      const int u0 = static_cast<int>(std::floor(x)), v0 = static_cast<int>(std::floor(y));
      const double a = x - u0, b = y - v0;
      to[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] =
          (1 - b) * ((1 - a) * at(u0, v0) + a * at(u0 + 1, v0)) +
          b * ((1 - a) * at(u0, v0 + 1) + a * at(u0 + 1, v0 + 1));
    }
  return to;
}

TEST(SegmentationNetworkOfAFile, OfHalfTheSizeSeesASmallerImageAndItsLogitsAreWidened) {
  const cv::Mat3b image = random_colours(5);
  std::vector<Plane> small;  // blue, green, red
  for (int channel = 0; channel < 3; ++channel) {
    Plane plane(48, std::vector<double>(64));
    for (std::size_t v = 0; v < 48; ++v)
      for (std::size_t u = 0; u < 64; ++u)
        plane[v][u] = image(static_cast<int>(v), static_cast<int>(u))[channel];
    small.push_back(plainly_resized(plane, 32, 24));
  }
  std::vector<Plane> logits(3, Plane(24, std::vector<double>(32)));
  for (std::size_t v = 0; v < 24; ++v)
    for (std::size_t u = 0; u < 32; ++u) {
      const auto of_pixel = crate_logits(small[2][v][u], small[1][v][u], small[0][v][u]);
      for (std::size_t c = 0; c < 3; ++c) logits[c][v][u] = of_pixel[c];
    }
  for (Plane& plane : logits) plane = plainly_resized(plane, 64, 48);
  SegmentationNetwork network({tiny_network("crate_half_size"), {}}, kTiny);
  EXPECT_EQ(network.input_size(), cv::Size(32, 24));
  expect_segmented(network.segment(image, {}, "image"), [&](int u, int v) {
    const auto row = static_cast<std::size_t>(v), column = static_cast<std::size_t>(u);
    return std::vector{logits[0][row][column], logits[1][row][column], logits[2][row][column]};
  });
}

TEST(SegmentationNetworkOfAFile, ASigmoidForEachClassIsNamed) {
  SegmentationNetwork sigmoid({.model = tiny_network("crate_sigmoid"),
                               .classes = {},
                               .output = NetworkOutput::probabilities},
                              kTiny);
  EXPECT_THAT(
      refusal_of([&] { (void)sigmoid.segment(random_colours(7), {}, "image 7"); }),
      HasSubstr("crate_sigmoid.onnx: its output for image 7 lies in 0..1 and does not add up "
                "to 1, as of a sigmoid for each class; end it with a softmax"));
}

TEST(SegmentationNetworkOfAFile, ProbabilitiesAreTakenAsTheyAre) {
  const cv::Mat3b image = random_colours(6);
  SegmentationNetwork logits({tiny_network("crate"), {}}, kTiny);
  NetworkModel model{tiny_network("crate_softmax"), {}};
  SegmentationNetwork wrong(model, kTiny);
  EXPECT_THAT(refusal_of([&] { (void)wrong.segment(image, {}, "image 7"); }),
              HasSubstr("crate_softmax.onnx: its output for image 7 is of probabilities that add "
                        "up to 1; write perception.network.output: probabilities"));
  model.output = NetworkOutput::probabilities;
  SegmentationNetwork softmax(model, kTiny);
  const Segmented a = logits.segment(image, {}, ""), b = softmax.segment(image, {}, "");
  EXPECT_EQ(cv::countNonZero(a.label != b.label), 0);
  EXPECT_LT(cv::norm(a.probability, b.probability, cv::NORM_INF), 1e-6);
  SegmentationNetwork none({.model = tiny_network("crate"), .classes = {}, .output = model.output},
                           kTiny);
  EXPECT_THAT(refusal_of([&] { (void)none.segment(image, {}, "image 7"); }),
              HasSubstr("is not of probabilities that add up to 1; write "
                        "perception.network.output: logits"));
}

TEST(SegmentationNetworkOfAFile, WhatDoesNotFitIsRefusedInOneLine) {
  struct Case {
    std::string name;
    std::vector<std::string> said;
  };
  const std::vector<Case> cases{
      {"five_channels", {"1 x 5 x 48 x 64", "1 x 3 x 48 x 64, or 1 x 4 x 48 x 64 with depth"}},
      {"wide", {"1 x 3 x 48 x 96", "48 x 64 (height x width)"}},
      {"opset_17", {"operator set 17", "9 to 13", "opset_version=11"}},
      {"nan_weights", {"'kernel'", "not finite"}},
      {"unknown_operator", {"OpenCV", "no operator Det"}},
      {"flat", {"an output of 1 x 9216", "1 x CLASSES x ROWS x COLUMNS"}},
      {"two_outputs", {"1 inputs and 2 outputs"}},
      {"none", {"no such file"}}};
  for (const Case& one : cases) {
    const std::string said = refusal_of([&] {
      SegmentationNetwork network({tiny_network(one.name), {}}, kTiny);
    });
    EXPECT_THAT(said, HasSubstr(one.name + ".onnx: "));
    for (const std::string& part : one.said) EXPECT_THAT(said, HasSubstr(part));
    EXPECT_EQ(said.find('\n'), said.npos);
  }
  SegmentationNetwork overflowing({tiny_network("overflowing"), {}}, kTiny);
  EXPECT_THAT(
      refusal_of([&] { (void)overflowing.segment(random_colours(7), {}, "tiny/color/7.png"); }),
      HasSubstr("its output for tiny/color/7.png is not of finite numbers"));
  EXPECT_THAT(refusal_of([&] {
                SegmentationNetwork network(
                    {.model = tiny_network("near"), .classes = {}, .mean = {1, 2, 3}}, kTiny);
              }),
              HasSubstr("takes 4 channels, and perception.network.mean has 3 numbers"));
}

TEST(SegmentationNetworkOfAFile, EveryCutOfTheFileIsRefusedInOneLine) {
  const mapscore::testing::TemporaryFolder folder;
  const std::string bytes = read_file(tiny_network("crate"));
  for (std::size_t count = 0; count < bytes.size(); ++count) {
    write_file(folder.path() / "cut.onnx", bytes.substr(0, count));
    const std::string said = refusal_of([&] {
      SegmentationNetwork network({folder.path() / "cut.onnx", {}}, kTiny);
    });
    EXPECT_THAT(said, HasSubstr("cut.onnx: ")) << count;
    EXPECT_EQ(said.find('\n'), said.npos);
  }
}

}  // namespace
}  // namespace mapscore::eval::testing
