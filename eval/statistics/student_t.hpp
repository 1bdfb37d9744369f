// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#pragma once

namespace mapscore::eval {

/// P(T <= t) of Student's distribution with `degrees` >= 1 degrees of freedom, by the finite
/// trigonometric series for whole degrees (Abramowitz and Stegun 26.7.3 and 26.7.4).
[[nodiscard]] double student_t_cdf(double t, int degrees);

/// t with student_t_cdf(t, degrees) = p. Throws Error unless 0 < p < 1 and degrees >= 1.
[[nodiscard]] double student_t_quantile(double p, int degrees);

}  // namespace mapscore::eval
