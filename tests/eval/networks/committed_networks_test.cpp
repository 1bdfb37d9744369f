// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT
//
// The networks of results/weights by OpenCV, held against what PyTorch computed of them
// (tests/network/README.md).

#include "eval/networks/segmentation_network.hpp"
#include "files/file_bytes.hpp"
#include "files/png.hpp"
#include "tests/eval/networks/tiny_networks.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace mapscore::eval::testing {
namespace {

namespace fs = std::filesystem;

const cv::Size kFrame(320, 240);

std::vector<fs::path> committed_networks() {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry :
       fs::directory_iterator(fs::path(MAPSCORE_SOURCE_DIR) / "results/weights", none))
    if (entry.path().extension() == ".onnx") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// The logits of the frame of tests/network, 1 x K x 240 x 320.
cv::Mat logits_of(const fs::path& network, const fs::path& folder) {
  const auto bytes = [&](const char* name) { return read_file(folder / name); };
  const cv::Mat3b color = decode_color_png(bytes("color.png"), kFrame, "color.png");
  cv::Mat1f depth_m;
  decode_grey16_png(bytes("depth.png"), kFrame, "depth.png")
      .convertTo(depth_m, CV_32F, 1.0 / 5000.0);
  SegmentationNetwork net({network, {}}, kFrame);
  return net.forward(net.input_of(color, depth_m), "color.png").clone();
}

TEST(CommittedNetworks, AreComputedAsByPyTorch) {
  constexpr double kMostDifference = 1e-4;
  const fs::path folder = fs::path(MAPSCORE_SOURCE_DIR) / "tests/network";
  const std::vector<fs::path> networks = committed_networks();
  ASSERT_FALSE(networks.empty()) << "results/weights holds no network";
  for (const fs::path& network : networks) {
    SCOPED_TRACE(network.filename());
    std::istringstream reference(read_file(folder / (network.stem().string() + ".logits.txt")));
    int classes = 0, rows = 0, columns = 0, step = 0, compared = 0;
    reference >> classes >> rows >> columns >> step;
    const cv::Mat logits = logits_of(network, folder);
    ASSERT_EQ(logits.size[1], classes);
    ASSERT_EQ(logits.size[2], kFrame.height);
    for (int k = 0; k < classes; ++k)
      for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
          double expected = 0;
          ASSERT_TRUE(reference >> expected);
          const auto given =
              static_cast<double>(logits.ptr<float>(0, k, step * row)[step * column]);
          ASSERT_NEAR(given, expected, kMostDifference) << k << ' ' << row << ' ' << column;
          ++compared;
        }
    EXPECT_GE(compared, 1000);
  }
}

}  // namespace
}  // namespace mapscore::eval::testing
