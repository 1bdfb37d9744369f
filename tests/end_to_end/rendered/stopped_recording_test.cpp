// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "tests/end_to_end/program.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace mapscore::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(StoppedRecording, LeavesNothingHalfMadeAndSaysHowToGoOn) {
  const TemporaryFolder folder;
  for (const char* verb : {"sweep", "tolerance"}) {
    const auto images = [&] {
      return std::ranges::count_if(contents_of(folder.path()), [](const std::string& name) {
        return name.find(".partial/color/") != std::string::npos;
      });
    };
    Process running(
        mapscore_command({verb, MAPSCORE_SOURCE_DIR "/configs/demo.yaml", "-o", folder.path(), "-q",
                          "-j", "1", "--set", "trajectory.frames_per_s=100"}));
    for (int tries = 0; tries < 6000 && images() < 3; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_GE(images(), 3);
    running.interrupt();
    const Outcome stopped = running.wait();
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_THAT(stopped.err, AllOf(HasSubstr("stopped while the recording was made"),
                                   HasSubstr("the same command makes the recording anew")));
    EXPECT_EQ(images(), 0);
  }
}

}  // namespace
}  // namespace mapscore::testing
