// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/geometry/pose.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/end_to_end/tiny_study.hpp"

#include <fmt/format.h>

#include <functional>
#include <sstream>

// Maps in another frame than the truth's, told and moved by the built program.

namespace mapscore::testing {
namespace {

/// A scene of three blocks that neither a turn nor a reflection brings onto itself.
class FrameOfAMap : public TinyStudy {
 protected:
  void SetUp() override {
    TinyStudy::SetUp();
    write_text(path("blocks.xml"), R"(<mujoco><worldbody>
      <light pos="0 0 3"/>
      <body name="crate"><geom type="box" size="1 .2 .1" pos="1 4 0"/></body>
      <body name="wall"><geom type="box" size=".2 .6 .1" pos=".2 4.8 0"/></body>
      <body name="post"><geom type="box" size=".2 .2 .4" pos=".2 4.2 .5"/></body>
    </worldbody></mujoco>)");
    write_text(path("blocks.classes.yaml"),
               "classes:\n  - {name: block, colour: \"FF0000\", detect: true, bodies: [\"*\"]}\n");
    expect_done(mapscore({"truth", path("blocks.xml"), "-o", path("truth.csv")}));
  }

  /// The middles of the truth's voxels, moved by `change`, as a map.
  void write_moved(const char* name,
                   const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& change) {
    std::istringstream truth(bytes_of(path("truth.csv")));
    std::string line, map = "x,y,z,class\n";
    std::getline(truth, line);
    for (char comma = 0; std::getline(truth, line);) {
      Eigen::Vector3d key;
      std::istringstream(line) >> key.x() >> comma >> key.y() >> comma >> key.z();
      const Eigen::Vector3d p = change(0.05 * (key + Eigen::Vector3d::Constant(0.5)));
      map += fmt::format("{},{},{},block\n", p.x(), p.y(), p.z());
    }
    write_text(path(name), map);
  }
  [[nodiscard]] Outcome score(const std::string& map,
                              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"score", path(map), "--truth", path("blocks.xml")};
    words.insert(words.end(), more.begin(), more.end());
    return mapscore(words);
  }
};

TEST_F(FrameOfAMap, AMirrorImageIsNamed) {
  write_moved("swapped.csv",
              [](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.z(), p.y()); });
  EXPECT_THAT(score("swapped.csv").err,
              ::testing::HasSubstr("mirror image; write its (x, z, y) as (x, y, z)"));
}

TEST_F(FrameOfAMap, AlignFindsAMovedMapAgain) {
  const Pose moved = Eigen::Translation3d(1.3, -2.1, 0.4) *
                     Eigen::AngleAxisd(2.2, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  write_moved("moved.csv", [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(moved * p); });
  const Outcome aligned = score("moved.csv", {"--align"});
  expect_done(aligned);
  // The flag that is the same as what was found undoes the motion to a centimetre.
  const std::string flag = "--transform '";
  const std::size_t begin = aligned.out.find(flag) + flag.size();
  std::istringstream numbers(aligned.out.substr(begin));
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  numbers >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
  const Pose left = Eigen::Translation3d(t) * q.normalized() * moved;
  const Eigen::Vector3d middle(1, 4.3, 0.2);
  EXPECT_LT((left * middle - middle).norm(), 0.01) << aligned.out;
  EXPECT_LT(Eigen::AngleAxisd(left.linear()).angle(), 0.01) << aligned.out;
}

}  // namespace
}  // namespace mapscore::testing
