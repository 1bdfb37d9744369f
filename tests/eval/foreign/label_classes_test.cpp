// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/foreign/label_classes.hpp"

#include "core/error.hpp"
#include "tests/support/tiny_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace mapscore::eval {
namespace {

using ::testing::HasSubstr;

class LabelClassFile : public ::testing::Test {
 protected:
  [[nodiscard]] LabelClasses read(const std::string& text,
                                  ClassMasks masks = ClassMasks::components) const {
    std::ofstream(folder_.path() / "classes.yaml") << text;
    return read_label_classes(folder_.path() / "classes.yaml", masks);
  }
  [[nodiscard]] std::string refusal(const std::string& text,
                                    ClassMasks masks = ClassMasks::components) const {
    try {
      (void)read(text, masks);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(LabelClassFile, LabelsAreIdsUnlessSaid) {
  const LabelClasses classes = read(
      "classes:\n  - {name: wall, label: 0, detect: false}\n  - {name: chair}\n"
      "  - {name: cup, label: 41, colour: \"FF8000\"}\n");
  EXPECT_FALSE(classes.has_instances);
  ASSERT_EQ(classes.class_of_pixel.size(), 42u);
  EXPECT_EQ(classes.class_of_pixel[0], 1);
  EXPECT_EQ(classes.class_of_pixel[2], 2);
  EXPECT_EQ(classes.class_of_pixel[41], 3);
  EXPECT_EQ(classes.class_of_pixel[7], kBackground);
  EXPECT_FALSE(classes.table.detected(1));
  EXPECT_TRUE(classes.table.detected(3));
  EXPECT_EQ(classes.table.classes[3].colour, (Colour{255, 128, 0}));
}

TEST_F(LabelClassFile, WithTheInstanceInAPixelLabelsEndAt255) {
  const std::string last = "classes: [{name: cup, label: [3, 255]}]\n";
  const std::string beyond = "classes: [{name: cup, label: [3, 256]}]\n";
  EXPECT_EQ(refusal(last, ClassMasks::instances), "");
  EXPECT_THAT(refusal(beyond, ClassMasks::instances), HasSubstr("label 256"));
  EXPECT_EQ(refusal(beyond, ClassMasks::components), "");
  EXPECT_EQ(refusal(beyond + "instances: [{id: 1, class: cup}]\n", ClassMasks::instances), "");
  EXPECT_THAT(refusal("classes: [{name: cup, label: []}]\n"), HasSubstr("names no label"));
}

TEST_F(LabelClassFile, InstancesNameTheirClass) {
  const LabelClasses classes = read(
      "classes: [{name: cup}, {name: chair}]\n"
      "instances: [{id: 3, class: chair}, {id: 1, class: cup}]\n");
  EXPECT_TRUE(classes.has_instances);
  EXPECT_EQ(classes.table.class_of(1), 1);
  EXPECT_EQ(classes.table.class_of(2), kBackground);
  EXPECT_EQ(classes.table.class_of(3), 2);
}

TEST_F(LabelClassFile, BadFilesAreNamed) {
  EXPECT_THAT(refusal("classes: [{name: cup}, {name: cup}]\n"), HasSubstr("this name"));
  EXPECT_THAT(refusal("classes: [{name: cup, label: 4}, {name: mug, label: 4}]\n"),
              HasSubstr("taken by cup"));
  EXPECT_THAT(refusal("classes: [{name: cup, label: 70000}]\n"), HasSubstr("label"));
  EXPECT_THAT(refusal("classes: [{name: cup, detect: false}]\n"),
              HasSubstr("no class is detected"));
  EXPECT_THAT(refusal("classes: [{name: cup, color: red}]\n"), HasSubstr("color"));
  EXPECT_THAT(refusal("classes: [{name: cup}]\ninstances: [{id: 1, class: mug}]\n"),
              HasSubstr("'mug'"));
}

/// Two cups that touch at a corner, a third apart, and a chair between.
const cv::Mat1w kLabel = (cv::Mat1w(3, 6) << 7, 0, 0, 5, 0, 7,  //
                          0, 7, 0, 5, 0, 7,                     //
                          0, 0, 0, 5, 0, 0);

TEST_F(LabelClassFile, ComponentsBecomeInstances) {
  const LabelClasses classes = read("classes: [{name: chair, label: 5}, {name: cup, label: 7}]\n");
  const LabelledImage image = instances_of(kLabel, classes, ClassMasks::components);
  EXPECT_EQ(image.instances(0, 3), 1);
  EXPECT_EQ(image.instances(0, 0), 2);
  EXPECT_EQ(image.instances(1, 1), 2);
  EXPECT_EQ(image.instances(1, 5), 3);
  EXPECT_EQ(image.instances(0, 1), 0);
  ASSERT_EQ(image.table.instances.size(), 4u);
  EXPECT_EQ(image.table.class_of(1), 1);
  EXPECT_EQ(image.table.class_of(2), 2);
  EXPECT_EQ(image.table.class_of(3), 2);
}

TEST_F(LabelClassFile, OneInstanceAClassWhereAsked) {
  const LabelClasses classes =
      read("classes: [{name: chair, label: 5, detect: false}, {name: cup, label: 7}]\n");
  const LabelledImage image = instances_of(kLabel, classes, ClassMasks::classes);
  EXPECT_EQ(image.table.instances.size(), 2u);
  EXPECT_EQ(image.instances(0, 3), 0);
  EXPECT_EQ(image.instances(0, 0), 1);
  EXPECT_EQ(image.instances(0, 5), 1);
}

}  // namespace
}  // namespace mapscore::eval
