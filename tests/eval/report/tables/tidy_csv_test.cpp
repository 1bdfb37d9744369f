// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/tables/tidy_csv.hpp"

#include "files/csv.hpp"
#include "tests/eval/report/pictures/swept_plate.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace mapscore::eval {
namespace {

using ::testing::StartsWith;

class TidyCsv : public testing::SweptPlate {
 protected:
  /// The whole text is too long for a message of HasSubstr.
  void expect_lines(const std::string& lines) const {
    EXPECT_NE(text().find(lines), std::string::npos) << lines;
  }
  [[nodiscard]] std::string text() const {
    std::ostringstream out;
    write_tidy_csv(summarise_store(results()), out);
    return out.str();
  }
};

/// All that is known of the plate shifted by a pixel; counted by hand, see plate_recording.hpp.
constexpr const char* kShiftedPlate[] = {"predicted,16",
                                         "true_predicted,12",
                                         "visible,16",
                                         "found,12",
                                         "false_near,0",
                                         "false_leak,4",
                                         "false_floating,0",
                                         "missed_mislabelled,0",
                                         "missed_unlabelled,0",
                                         "missed_unmapped,4",
                                         "visible_4,0",  // each of its voxels has one sample
                                         "found_4,0",
                                         "true_predicted_t1,12",
                                         "found_t1,16",
                                         "boxes,1",
                                         "boxes_unseen,0",
                                         "precision,0.75",
                                         "recall,0.75",
                                         "f1,0.75",
                                         "iou,0.6",
                                         "recall_4,-",
                                         "f1_4,-",
                                         "iou_4,-",
                                         "precision_t1,0.75",
                                         "recall_t1,1",
                                         "f1_t1,0.857142857",
                                         "precision_1cm,0.75",
                                         "recall_1cm,0.75",
                                         "f_1cm,0.75",
                                         "precision_2cm,0.75",
                                         "recall_2cm,0.75",
                                         "f_2cm,0.75",
                                         "precision_5cm,0.75",
                                         "recall_5cm,1",
                                         "f_5cm,0.857142857",
                                         "precision_10cm,0.75",
                                         "recall_10cm,1",
                                         "f_10cm,0.857142857",
                                         "accuracy_mean_m,0.123136104",
                                         "accuracy_p95_m,0.493",
                                         "completeness_mean_m,0.00625",
                                         "completeness_p95_m,0.025",
                                         "ap,0.5625",
                                         "brier,0.25",
                                         "ece,0.25",
                                         "box_iou,0.037497588",
                                         "box_25,0",
                                         "box_50,0",
                                         "box_75,0",
                                         "f1_best,-",
                                         "threshold_best,-"};

TEST_F(TidyCsv, OfThePlateIsWhatIsCountedByHand) {
  sweep();
  std::string expected;
  for (const char* line : kShiftedPlate)
    expected += std::string("trial,direct,0,\"[0.05, 0, 0]\",plate,") + line + '\n';
  expect_lines(expected);
  expect_lines("trial,direct,0,\"[0, 0, 0]\",plate,f1,1\n");
  expect_lines("registration_ceiling,direct,0,\"[0.05, 0, 0]\",plate,f1,1\n");
  expect_lines("lattice_ceiling,direct,0,\"[0.05, 0, 0]\",pooled,recall,1\n");
  expect_lines("trial,direct,0,\"[0.05, 0, 0]\",all,points,16\n");
}

TEST_F(TidyCsv, MacroNamesItsRecallAndIou) {
  sweep();
  expect_lines(
      "trial,direct,0,\"[0.05, 0, 0]\",macro,mpa,0.75\n"
      "trial,direct,0,\"[0.05, 0, 0]\",macro,miou,0.6\n");
}

TEST_F(TidyCsv, EveryLineHasTheColumnsOfTheHeader) {
  sweep();
  const std::string all = text();
  EXPECT_THAT(all, StartsWith("role,method,seed,faults.misregistration.translation_m,"
                              "class,metric,value\n"));
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);)
    EXPECT_EQ(csv_cells(line, 9)->size(), 7u) << line;
}

TEST_F(TidyCsv, PooledAndTheOnlyClassAgree) {
  sweep();
  for (const char* line : kShiftedPlate)
    expect_lines(std::string("\"[0.05, 0, 0]\",pooled,") + line + '\n');
}

}  // namespace
}  // namespace mapscore::eval
