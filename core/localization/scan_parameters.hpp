// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

#include "core/localization/scan_likelihood.hpp"

namespace mapscore {

/// Throws Error naming the parameter that is out of range.
void check_parameters(const LikelihoodFieldParams& params, double range_max_m);
void check_parameters(const BeamModelParams& params, double range_max_m);

}  // namespace mapscore
