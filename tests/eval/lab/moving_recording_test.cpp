// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#ifdef MAPSCORE_SIMULATOR

#include "core/error.hpp"
#include "eval/lab/lattice_truth.hpp"
#include "eval/lab/trial_run.hpp"
#include "eval/lab/truth_cache.hpp"
#include "eval/render/study_recording.hpp"
#include "files/file_bytes.hpp"
#include "tests/sim/render/rendered_frames.hpp"
#include "tests/support/tiny_recording.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>
#include <string>

namespace mapscore::eval {
namespace {

const char* const kClasses =
    "classes:\n  - {name: person}\n  - {name: wall, detect: false}\n  - {name: cup}\n";

/// An arm that swings before a wall and brushes it, and a cup whose place the arm passes.
std::string scene_text(const std::string& arm_pose) {
  return "<mujoco><asset><mesh name='hand' vertex='0 0 0  .3 0 0  0 .2 0  0 0 .2'/></asset>"
         "<worldbody>"
         "<body name='wall_1'><geom type='box' pos='2.5 0 1' size='.1 1.5 1'/></body>"
         "<body name='cup_1'><geom type='cylinder' pos='2 .4 1' size='.1 .15'/></body>"
         "<body name='person_1' pos='1.9 0 1' " +
         arm_pose +
         "<geom type='capsule' fromto='0 0 0 .45 0 0' size='.06'/>"
         "<geom type='sphere' pos='.5 0 0' size='.11'/>"
         "<geom type='mesh' mesh='hand' pos='0 0 .3'/></body>"
         "</worldbody></mujoco>";
}

constexpr double kTurn_rad = 1.4;

class MovingRecording : public ::testing::Test {
 protected:
  MovingRecording() {
    std::filesystem::copy_file(std::filesystem::path(MAPSCORE_SOURCE_DIR) / "tests/data/robot.xml",
                               temporary_.path() / "robot.xml");
    write("scene.xml", scene_text("><joint name='swing' axis='0 0 1'/>"));
    write("scene.classes.yaml", kClasses);
    write("swing.csv", "stamp_s,swing\n0,0\n1,1.4\n");
    write("still.csv", "stamp_s,swing\n0,0\n1,0\n");
  }

  [[nodiscard]] Study study(const std::string& motion, const std::string& more = "") const {
    return parse_study("scene: scene.xml\n" +
                           (motion.empty() ? std::string() : "motion: " + motion + "\n") +
                           "trajectory: {waypoints_m_deg: [[0.3, 0.1, 2]], frames_per_s: 5}\n"
                           "cameras: {width_px: 160, height_px: 120}\n"
                           "methods: {direct: {segmentation: {direct: {}}}}\nseeds: 2\n" +
                           more,
                       temporary_.path() / "study.yaml");
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(temporary_.path() / name) << text;
    return temporary_.path() / name;
  }
  [[nodiscard]] Recording recorded(const std::string& name, const Study& of, int jobs = 2) const {
    record_study(of, temporary_.path() / name, jobs, {});
    return Recording::open(temporary_.path() / name);
  }
  [[nodiscard]] std::string bytes(const std::string& file) const {
    return read_file(temporary_.path() / file);
  }
  /// The scene with the arm turned by hand, without a joint.
  [[nodiscard]] SceneSurfaces posed(double turn_rad) const {
    const std::string degrees = fmt::format("{}", turn_rad * 180 / std::numbers::pi);
    const std::string name = "posed" + degrees + ".xml";
    write(name, scene_text("axisangle='0 0 1 " + degrees + "'>"));
    std::filesystem::copy_file(temporary_.path() / "scene.classes.yaml",
                               (temporary_.path() / name).replace_extension(".classes.yaml"));
    return surfaces_of_scene(temporary_.path() / name);
  }

  mapscore::testing::TemporaryFolder temporary_;
};

TEST_F(MovingRecording, HasTheSameBytesForAnyNumberOfJobsAndReadsBack) {
  const Recording one = recorded("one", study("swing.csv"), 1);
  const Recording three = recorded("three", study("swing.csv"), 3);
  ASSERT_EQ(one.frame_count(), 6);  // until the motion ends
  EXPECT_EQ(one.content_hash(), three.content_hash());
  EXPECT_EQ(one.info().motion, "swing.csv");
  EXPECT_EQ(bytes("one/truth/poses.csv"), bytes("three/truth/poses.csv"));
  const ShapePoses poses = one.read_poses();
  EXPECT_EQ(poses.shapes, (std::vector<std::size_t>{2, 3, 4}));  // capsule, sphere; the mesh last
  EXPECT_EQ(poses.stamps_s.size(), 6u);
  const std::vector<Shape> last = poses.at(one.read_shapes(), 5);
  const Eigen::Vector3d sphere = last[3].T_world_shape.translation();
  EXPECT_NEAR(sphere.x(), 1.9 + 0.5 * std::cos(kTurn_rad), 1e-9);
  EXPECT_NEAR(sphere.y(), 0.5 * std::sin(kTurn_rad), 1e-9);
}

TEST_F(MovingRecording, OfAMotionThatStandsStillIsTheStillRecording) {
  Study still = study("");
  (void)recorded("moving", study("still.csv"));
  (void)recorded("still", still);
  for (const char* file : {"color/000000.png", "depth/000000.png", "label/000000.png",
                           "depth_label/000000.png", "truth/shapes.csv", "truth/triangles.ply"})
    EXPECT_EQ(bytes(std::string("moving/") + file), bytes(std::string("still/") + file)) << file;
  EXPECT_EQ(bytes("moving/color/000005.png"), bytes("still/color/000000.png"));
  EXPECT_FALSE(std::filesystem::exists(temporary_.path() / "still/truth/poses.csv"));
  EXPECT_TRUE(Recording::open(temporary_.path() / "moving").read_poses().empty());
}

TEST_F(MovingRecording, TruthOfAFrameIsThatOfTheScenePosedByHandVoxelByVoxel) {
  const Recording recording = recorded("moving", study("swing.csv"));
  const ClassTable& table = recording.info().table;
  FrameCache frames(recording, {.label = false, .depth = true, .depth_label = true}, 1 << 24);
  TruthCache cache(recording, table, frames, 1);
  const MapFrame map_frame{0.04, {0.013, -0.007, 0.021}, 0.3};
  std::size_t different = 0;
  for (int frame = 0; frame < recording.frame_count(); ++frame) {
    const SceneSurfaces by_hand = posed(kTurn_rad * recording.depth_stamp_s(frame));
    const SurfacesAt expected = surfaces_of(by_hand.shapes, by_hand.table, map_frame, 0.0005, 1);
    const auto truth = cache.get(map_frame, {.depth_image = frame});
    ASSERT_TRUE(std::ranges::equal(truth->surface.voxels(), expected.surface.voxels())) << frame;
    EXPECT_GT(truth->view.visible.count(1), 20u);
    for (int n = 0; n < 50; ++n) {
      const VoxelKey key{40 + n % 7, n % 11 - 5, 20 + n % 5};
      EXPECT_NEAR(truth->distance_to_class(key, 1), expected.distance_to_class(key, 1), 1e-9);
    }
    different += std::ranges::equal(truth->surface.voxels(),
                                    cache.get(map_frame, {.depth_image = 0})->surface.voxels())
                     ? 0
                     : 1;
  }
  EXPECT_EQ(different, 5u);
}

/// Pooled recall and precision of the lattice ceiling.
TEST_F(MovingRecording, LatticeCeilingByFrameIsNextToOne) {
  const Recording recording = recorded("moving", study("swing.csv"));
  const Study by_frame = study("swing.csv", "score: {unit: frame, instances: true}\n");
  FrameCache frames(recording, {.depth = true, .depth_label = true}, 1 << 24);
  TruthCache truths(recording, recording.info().table, frames, 1);
  const Task task = task_of(by_frame, trials(by_frame)[0], Labels::truth, recording.content_hash());
  PoseSources poses(recording);
  TrialRun run(task, recording, recording.info().table, truths, poses);
  for (int frame = 0; frame < recording.frame_count(); ++frame) run.advance(*frames.get(frame));
  const TrialResult result = run.finish();
  for (const ClassId c : {1, 3}) {
    const ClassCounts& counts = result.counts[c];
    ASSERT_GT(counts.visible, 100);
    EXPECT_GE(static_cast<double>(counts.found), 0.995 * static_cast<double>(counts.visible));
    EXPECT_GE(static_cast<double>(counts.true_predicted),
              0.995 * static_cast<double>(counts.predicted));
  }
}

TEST_F(MovingRecording, MapsNeedATimeWithinTheRecording) {
  const Recording recording = recorded("moving", study("swing.csv"));
  FrameCache frames(recording, {.label = false, .depth = true, .depth_label = true}, 1 << 24);
  TruthCache cache(recording, recording.info().table, frames, 1);
  const auto refused = [&](const TruthOptions& options) -> std::string {
    try {
      (void)cache.get({}, options);
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refused({}), ::testing::HasSubstr("score.at_s"));
  EXPECT_THAT(refused({.at_s = 1.1}), ::testing::HasSubstr("give a time from 0 to 1 s"));
  EXPECT_THAT(refused({}), ::testing::Not(::testing::HasSubstr("\n")));
  const auto later = cache.get({}, {.at_s = 0.61});
  EXPECT_TRUE(std::ranges::equal(later->surface.voxels(),
                                 cache.get({}, {.depth_image = 3})->surface.voxels()));
  EXPECT_THROW((void)study("swing.csv", "score: {unit: frame, at_s: 1}\n"), Error);
}

TEST_F(MovingRecording, RefusesDamagedPosesInOneLine) {
  (void)recorded("moving", study("swing.csv"));
  const std::filesystem::path file = temporary_.path() / "moving/truth/poses.csv";
  const std::string whole = read_file(file);
  const auto refused = [&](const std::string& text, const std::string& part) {
    std::ofstream(file) << text;
    try {
      (void)Recording::open(temporary_.path() / "moving").read_poses();
      ADD_FAILURE() << part;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(part));
      EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
    }
  };
  const std::string header = whole.substr(0, whole.find('\n') + 1);
  refused("", ":1: the first line");
  refused(whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1), "poses for 3 shapes");
  refused(header + "0,99,0,0,0,0,0,0,1\n", "shape 99 is not in");
  refused(header + "0,2,0,0,0,0,0,0,2\n", "not of length 1");
  refused(header + "0,2,0,0,nan,0,0,0,1\n", "expected 9 finite numbers");
  refused(header + "0,2,0,0,0,0,0,0,1\n0.3,2,0,0,0,0,0,0,1\n", "stamp 0.3");
  refused(header + "0.2,2,0,0,0,0,0,0,1\n", "stamp 0.2");
  std::filesystem::remove(file);
  EXPECT_THROW((void)Recording::open(temporary_.path() / "moving").read_poses(), Error);
}

TEST_F(MovingRecording, ColourAndDepthHaveInstantsOfTheirOwn) {
  const sim::World world = world_of(study("swing.csv"));
  sim::Renderer moving(world, false);
  const sim::StampedPose color{0.25, planar_pose(0.3, 0.1, 0.03)},
      depth{0.9, planar_pose(0.2, 0, 0)};
  const Frame frame = sim::testing::frame_at(moving, color, depth);
  sim::Renderer early(world.at(0.25), false), late(world.at(0.9), false);
  const Frame then = sim::testing::frame_at(early, color.T_world_base);
  const Frame later = sim::testing::frame_at(late, depth.T_world_base);
  EXPECT_EQ(cv::norm(frame.color, then.color, cv::NORM_L1), 0);
  EXPECT_EQ(cv::norm(frame.label, then.label, cv::NORM_L1), 0);
  EXPECT_EQ(cv::norm(frame.depth, later.depth, cv::NORM_L1), 0);
  EXPECT_EQ(cv::norm(frame.depth_label, later.depth_label, cv::NORM_L1), 0);
  EXPECT_GT(cv::norm(frame.label, later.label, cv::NORM_L1), 0);
  EXPECT_EQ(frame.stamp_s, 0.9);
}

}  // namespace
}  // namespace mapscore::eval

#endif
