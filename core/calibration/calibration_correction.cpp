// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "core/calibration/calibration_correction.hpp"

#include <cmath>

namespace mapscore {

CalibrationCorrection CalibrationCorrection::changed(const Vector& by) const {
  CalibrationCorrection after = *this;
  after.rigid.linear() = exp_rotation(by.segment<3>(turn_x)) * rigid.linear();
  after.rigid.translation() = rigid.translation() + by.segment<3>(shift_x);
  after.log_focal += by[focal];
  after.centre_px += by.segment<2>(centre_u);
  after.time_s += by[time];
  after.offset_px += by[kMaskSize];
  return after;
}

CalibrationCorrection::Vector CalibrationCorrection::vector() const {
  Vector all;
  const Eigen::AngleAxisd turn(rigid.linear());
  all << turn.angle() * turn.axis(), rigid.translation(), log_focal, centre_px, time_s, offset_px;
  return all;
}

Calibration CalibrationCorrection::applied(const Calibration& start) const {
  Calibration corrected = start;
  corrected.T_color_depth = rigid * start.T_color_depth;
  corrected.color.fx_px *= std::exp(log_focal);
  corrected.color.fy_px *= std::exp(log_focal);
  corrected.color.cx_px += centre_px.x();
  corrected.color.cy_px += centre_px.y();
  return corrected;
}

}  // namespace mapscore
