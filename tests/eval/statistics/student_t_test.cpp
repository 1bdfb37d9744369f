// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/statistics/student_t.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

namespace mapscore::eval {
namespace {

TEST(StudentT, QuantilesEqualThePublishedTable) {
  struct Row {
    int degrees;
    double t975, t95;
  };
  for (const Row& row :
       {Row{1, 12.7062047, 6.3137515}, Row{2, 4.3026527, 2.9199856}, Row{3, 3.1824463, 2.3533634},
        Row{4, 2.7764451, 2.1318468}, Row{9, 2.2621572, 1.8331129}, Row{10, 2.2281389, 1.8124611},
        Row{29, 2.0452296, 1.6991270}, Row{30, 2.0422725, 1.6972609},
        Row{120, 1.9799304, 1.6576509}}) {
    EXPECT_NEAR(student_t_quantile(0.975, row.degrees), row.t975, 1e-6) << row.degrees;
    EXPECT_NEAR(student_t_quantile(0.95, row.degrees), row.t95, 1e-6) << row.degrees;
    EXPECT_NEAR(student_t_quantile(0.025, row.degrees), -row.t975, 1e-6) << row.degrees;
  }
  EXPECT_NEAR(student_t_quantile(0.975, 100000), 1.9599640, 1e-4);
  EXPECT_NEAR(student_t_quantile(0.5, 7), 0.0, 1e-12);
}

TEST(StudentT, QuantileInvertsTheDistribution) {
  for (const int degrees : {1, 2, 3, 4, 5, 8, 17, 50, 999}) {
    for (const double p : {0.001, 0.1, 0.3, 0.6, 0.9, 0.999}) {
      EXPECT_NEAR(student_t_cdf(student_t_quantile(p, degrees), degrees), p, 1e-12);
    }
  }
  EXPECT_THROW(static_cast<void>(student_t_quantile(1.0, 3)), Error);
  EXPECT_THROW(static_cast<void>(student_t_quantile(0.975, 0)), Error);
}

}  // namespace
}  // namespace mapscore::eval
