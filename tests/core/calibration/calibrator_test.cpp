// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibrator.hpp"

#include "core/error.hpp"
#include "core/localization/nees.hpp"
#include "core/random_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <vector>

namespace mapscore {
namespace {

constexpr double kInDegrees = 180 / std::numbers::pi;

/// A rectangle parallel to the image planes, in depth_optical, metres.
struct Board {
  double left, right, top, bottom, z;
};

/// Boards before a wall at 6 m, drawn by chance for each frame: each at a depth of its own, or all
/// at `plane_m`. The wall may be papered with squares of one mask, `paper_px` wide, whose outlines
/// are no steps.
class BoardScene {
 public:
  explicit BoardScene(std::optional<double> plane_m = {}, int paper_px = 0)
      : plane_m_(plane_m), paper_px_(paper_px) {
    truth_.color = CameraModel::from_hfov(320, 240, 60 / kInDegrees);
    truth_.depth = CameraModel::from_hfov(320, 240, 58.4 / kInDegrees);
    truth_.T_color_depth.translation() = Eigen::Vector3d(-0.025, 0, 0);
    table_.classes.push_back({1, "board", {}, true});
    for (InstanceId id = 1; id <= kPaper; ++id) table_.instances.push_back({id, "board", 1});
  }

  [[nodiscard]] Calibration off_by(const Eigen::Vector3d& shift_m,
                                   const Eigen::Vector3d& turn_rad) const {
    Calibration start = truth_;
    Pose error = Pose::Identity();
    error.linear() = exp_rotation(turn_rad);
    error.translation() = shift_m;
    start.T_color_depth = error * truth_.T_color_depth;
    return start;
  }
  [[nodiscard]] const Calibration& truth() const { return truth_; }

  /// Frame `n` with its first `boards` boards in the masks; all are in the depth image.
  [[nodiscard]] Sight frame(int n, const Calibration& believed, InstanceId boards = kBoards) const {
    const std::vector<Board> all = boards_of(n);
    cv::Mat1w depth(240, 320), label(240, 320);
    for (int v = 0; v < 240; ++v)
      for (int u = 0; u < 320; ++u) {
        depth(v, u) = cv::saturate_cast<std::uint16_t>(kDepthUnitsPerMetre *
                                                       seen(all, truth_.depth, 0.0, u, v).second);
        const InstanceId id = seen(all, truth_.color, 0.025, u, v).first;
        const bool on_paper = paper_px_ > 0 && id == 0 && (u / paper_px_ + v / paper_px_) % 2 == 0;
        label(v, u) = on_paper ? kPaper : id <= boards ? id : InstanceId{0};
      }
    return {believed, depth, detections_of(label, table_)};
  }

 private:
  static constexpr InstanceId kBoards = 6, kPaper = 7;

  [[nodiscard]] std::vector<Board> boards_of(int n) const {
    RandomStream draws(7, "boards", {static_cast<std::uint64_t>(n)});
    std::vector<Board> boards;
    for (InstanceId id = 1; id <= kBoards; ++id) {
      const double own_z = 1.0 + 3.5 * draws.uniform(), z = plane_m_.value_or(own_z);
      const double u = (draws.uniform() - 0.5) * z, v = (draws.uniform() - 0.5) * 0.7 * z;
      const double half = (0.04 + 0.08 * draws.uniform()) * z;
      boards.push_back({u - half, u + half, v - half, v + half, z});
    }
    return boards;
  }
  /// Instance and depth that a camera at (eye_x, 0, 0) sees.
  [[nodiscard]] static std::pair<InstanceId, double> seen(const std::vector<Board>& boards,
                                                          const CameraModel& camera, double eye_x,
                                                          int u, int v) {
    std::pair<InstanceId, double> nearest{InstanceId{0}, 6.0};
    for (std::size_t n = 0; n < boards.size(); ++n) {
      const Board& board = boards[n];
      const Eigen::Vector3d p = camera.back_project(u, v, board.z) + Eigen::Vector3d(eye_x, 0, 0);
      if (board.z < nearest.second && p.x() >= board.left && p.x() <= board.right &&
          p.y() >= board.top && p.y() <= board.bottom)
        nearest = {static_cast<InstanceId>(n + 1), board.z};
    }
    return nearest;
  }

  std::optional<double> plane_m_;
  int paper_px_;
  Calibration truth_;
  ClassTable table_;
};

CalibrationEstimate estimated(const BoardScene& scene, const Calibration& start, int frames,
                              InstanceId boards = 6, int first = 0) {
  Calibrator calibrator(start);
  for (int n = 0; n < frames; ++n) calibrator.add(scene.frame(first + n, start, boards));
  return calibrator.estimate();
}

/// Expects that each of `draws` is refused, with a direction in its reason.
void expect_undetermined(const BoardScene& scene, InstanceId boards, int draws) {
  constexpr int kFrames = 3;
  for (int draw = 0; draw < draws; ++draw) {
    RandomStream by(5, "start", {static_cast<std::uint64_t>(draw)});
    const Eigen::Vector3d shift(0.02 * by.normal(), 0.02 * by.normal(), 0.005 * by.normal()),
        turn(0.01 * by.normal(), 0.01 * by.normal(), 0.01 * by.normal());
    const Calibration start = scene.off_by(shift, turn);
    const CalibrationEstimate estimate = estimated(scene, start, kFrames, boards, kFrames * draw);
    EXPECT_EQ(estimate.verdict, CalibrationVerdict::undetermined)
        << draw << ": condition " << estimate.condition << ", " << estimate.weakest << " "
        << estimate.weakest_px << " px, " << estimate.objects << " outlines";
    EXPECT_FALSE(estimate.weakest.empty());
    EXPECT_TRUE(estimate.reason.starts_with(estimate.weakest)) << estimate.reason;
    EXPECT_EQ(estimate.calibration.T_color_depth.matrix(), start.T_color_depth.matrix());
  }
}

/// Error of an estimate: turn (radians), then shift (metres).
Vector6 error_of(const CalibrationEstimate& estimate, const Calibration& truth) {
  const Pose error = estimate.calibration.T_color_depth * truth.T_color_depth.inverse();
  const Eigen::AngleAxisd turn(error.linear());
  Vector6 xi;
  xi << turn.angle() * turn.axis(), error.translation();
  return xi;
}

TEST(Calibrator, FindsShiftAndTurnTogether) {
  const BoardScene scene;
  const Calibration start = scene.off_by({0.03, -0.02, 0.005}, {0.02, -0.03, 0.01});
  const CalibrationEstimate estimate = estimated(scene, start, 12);
  ASSERT_EQ(estimate.verdict, CalibrationVerdict::calibrated) << estimate.reason;
  const Vector6 error = error_of(estimate, scene.truth());
  EXPECT_LT(error.head<3>().norm() * kInDegrees, 0.05);
  EXPECT_LT(error.tail<3>().norm(), 0.002);
  EXPECT_LT(nees<6>(error, Covariance6(estimate.covariance.topLeftCorner<6, 6>())), 25.0);
  EXPECT_GT(estimate.explained, estimate.explained_start + 0.2);
}

/// Never worse than the start without saying so: of starts that are less and less wrong the first
/// are surely improved, then perhaps, and the last are confirmed.
TEST(Calibrator, SaysWhereTheStartMayBeBetter) {
  const BoardScene scene;
  std::vector<int> stages;
  for (const double scale : {1.0, 0.3, 0.1, 0.05, 0.03, 0.02, 0.015, 0.01, 0.005, 0.002, 0.0}) {
    const Eigen::Vector3d shift(0.03, -0.02, 0.005), turn(0.02, -0.03, 0.01);
    const CalibrationEstimate estimate =
        estimated(scene, scene.off_by(scale * shift, scale * turn), 12);
    ASSERT_TRUE(is_known(estimate.verdict)) << estimate.reason;
    stages.push_back(estimate.verdict == CalibrationVerdict::confirmed ? 2
                     : estimate.may_be_worse                           ? 1
                                                                       : 0);
  }
  EXPECT_TRUE(std::ranges::is_sorted(stages));
  for (const int stage : {0, 1, 2}) EXPECT_GT(std::ranges::count(stages, stage), 0) << stage;
}

/// Where edges lie closely on outlines, few of these are enough.
TEST(Calibrator, FewOutlinesOnStepsSufficeWhereTheyFitClosely) {
  const BoardScene scene({}, 20);
  const Calibration start = scene.off_by({0.03, -0.02, 0.005}, {0.02, -0.03, 0.01});
  const CalibrationEstimate estimate = estimated(scene, start, 12);
  EXPECT_LT(estimate.explained, 0.14);
  EXPECT_LT(estimate.sigma_px, 0.8F);
  ASSERT_EQ(estimate.verdict, CalibrationVerdict::calibrated) << estimate.reason;
  const Vector6 error = error_of(estimate, scene.truth());
  EXPECT_LT(error.head<3>().norm() * kInDegrees, 0.05);
  EXPECT_LT(error.tail<3>().norm(), 0.002);
}

/// Masks of one frame and the depth image of another.
TEST(Calibrator, ImagesThatDoNotBelongTogetherAreRefused) {
  const BoardScene scene({}, 40);
  for (int draw = 0; draw < 20; ++draw) {
    Calibrator calibrator(scene.truth());
    for (int n = 6 * draw; n < 6 * draw + 6; ++n)
      calibrator.add({scene.truth(), scene.frame(n + 500, scene.truth()).depth(),
                      scene.frame(n, scene.truth()).detections()});
    const CalibrationEstimate estimate = calibrator.estimate();
    EXPECT_FALSE(is_known(estimate.verdict))
        << draw << ": " << estimate.explained << " within " << estimate.sigma_px << " px";
  }
}

/// An estimate that explains less than a hundredth of the outlines more is not called sure.
TEST(Calibrator, SaysWhereItExplainsHardlyMore) {
  const BoardScene scene({}, 40);
  int hardly_more = 0;
  for (const double scale : {0.3, 0.1, 0.07, 0.05, 0.04, 0.03, 0.02}) {
    const CalibrationEstimate estimate =
        estimated(scene,
                  scene.off_by(scale * Eigen::Vector3d(0.03, -0.02, 0.005),
                               scale * Eigen::Vector3d(0.02, -0.03, 0.01)),
                  12);
    ASSERT_TRUE(is_known(estimate.verdict)) << estimate.reason;
    if (estimate.verdict != CalibrationVerdict::calibrated) continue;
    const double more = estimate.explained - estimate.explained_start;
    EXPECT_TRUE(more >= 0.01 || estimate.may_be_worse) << scale << ": " << more;
    hardly_more += more < 0.01 ? 1 : 0;
  }
  EXPECT_GT(hardly_more, 0);
}

TEST(Calibrator, ConfirmsARightStart) {
  const BoardScene scene;
  const CalibrationEstimate estimate = estimated(scene, scene.truth(), 12);
  EXPECT_EQ(estimate.verdict, CalibrationVerdict::confirmed) << estimate.reason;
  EXPECT_EQ(error_of(estimate, scene.truth()), Vector6(Vector6::Zero()));
  EXPECT_LT(estimate.correction.rigid.translation().norm(), 0.002);
}

TEST(Calibrator, OneObjectIsTooFew) {
  const BoardScene scene;
  const Calibration start = scene.off_by({0.02, 0, 0}, {0, 0.01, 0});
  const CalibrationEstimate estimate = estimated(scene, start, 1, 1);
  EXPECT_EQ(estimate.verdict, CalibrationVerdict::undetermined);
  EXPECT_FALSE(estimate.reason.empty());
  EXPECT_TRUE(estimate.calibration.T_color_depth.isApprox(start.T_color_depth));
}

TEST(Calibrator, OnePlaneIsRefusedAlways) {
  expect_undetermined(BoardScene(2.0), 6, 100);
}
TEST(Calibrator, OneBoardIsRefusedAlways) {
  expect_undetermined(BoardScene(2.0), 1, 100);
}

// A robot that stands: the same frame again tells nothing new, and no certainty comes of it.
TEST(Calibrator, AFrameThatRepeatsCountsOnce) {
  const BoardScene scene;
  const Calibration start = scene.off_by({0.01, -0.01, 0}, {0.01, 0, 0});
  Calibrator once(start), often(start);
  for (int n = 0; n < 6; ++n) {
    const Sight sight = scene.frame(n, start);
    once.add(sight);
    for (int again = 0; again < 4; ++again) often.add(sight);
  }
  const CalibrationEstimate a = once.estimate(), b = often.estimate();
  EXPECT_NEAR(a.objects, b.objects, 0.05 * a.objects);
  EXPECT_TRUE(a.covariance.isApprox(b.covariance, 0.05));
}

TEST(Calibrator, WithoutMasksTheStartIsGiven) {
  const BoardScene scene;
  const CalibrationEstimate estimate = estimated(scene, scene.truth(), 2, 0);
  EXPECT_EQ(estimate.verdict, CalibrationVerdict::undetermined);
  EXPECT_EQ(estimate.reason,
            "no frame has a mask near a step of depth; add frames with objects in view, and see "
            "that depth images hold depths within the cameras' range and that the start is near");
}

TEST(Calibrator, SaysWhatEachFrameContributed) {
  const BoardScene scene;
  const CalibrationEstimate estimate = estimated(scene, scene.off_by({0.01, 0, 0}, {0, 0, 0}), 8);
  ASSERT_EQ(estimate.frames.size(), 8U);
  double information = 0;
  for (const FrameContribution& frame : estimate.frames) {
    EXPECT_GT(frame.edges, 0U);
    EXPECT_GT(frame.left_out_px, 0.9 * frame.residual_px);
    information += frame.information;
  }
  EXPECT_NEAR(information, 1.0, 0.05);
}

TEST(Calibrator, SameFramesSameResult) {
  const BoardScene scene;
  const Calibration start = scene.off_by({0.02, 0.01, 0}, {0.01, 0, 0});
  const CalibrationEstimate a = estimated(scene, start, 4), b = estimated(scene, start, 4);
  EXPECT_EQ(a.correction.vector(), b.correction.vector());
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(Calibrator, FramesOfOtherCamerasAreRefused) {
  const BoardScene scene;
  Calibrator calibrator(scene.truth());
  EXPECT_THROW(calibrator.add(scene.frame(0, scene.off_by({0.01, 0, 0}, {0, 0, 0}))), Error);
}

TEST(Calibrator, CamerasThatStandInDifferentRoomsAreRefused) {
  const BoardScene scene;
  EXPECT_THROW(Calibrator(scene.off_by({1e300, 0, 0}, {0, 0, 0})), Error);
  EXPECT_THROW(Calibrator(scene.off_by({0, 11, 0}, {0, 0, 0})), Error);
  Calibration far_base = scene.truth();
  far_base.T_base_depth.translation().z() = 1e300;
  EXPECT_THROW(Calibrator{far_base}, Error);
}

}  // namespace
}  // namespace mapscore
