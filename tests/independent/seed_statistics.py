# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Statistics over seeds by docs/metrics.md: ranges and intervals, sign-flip permutation, Holm's correction."""

import numpy as np
from scipy.optimize import brentq
from scipy.stats import permutation_test
from scipy.stats import t as student_t

LEAST_FOR_INTERVAL, MOST_FOR_EXACT, PATTERNS = 10, 20, 99_999
MOST_FOR_SCIPY = 12  # it takes 20 s for 2^20 patterns


def hall_limits(values):
    """mean - T sd at both ends, T the root of a cubic that rises everywhere."""
    n, mean, sd = len(values), values.mean(), values.std(ddof=1)
    g = ((values - mean)**3).mean() / values.std()**3
    x = student_t.ppf(0.975, n - 1) / np.sqrt(n)

    def root(wanted):
        return brentq(lambda T: T + g * T**2 / 3 + g**2 * T**3 / 27 + g / (6 * n) - wanted, -1e3, 1e3, xtol=1e-14)
    return mean - root(x) * sd, mean - root(-x) * sd


def spread(values):
    """(low, high) of one value a seed: a range, or from ten values on the farther of Student's and Hall's limits."""
    values = np.asarray(values, float)
    if len(values) < LEAST_FOR_INTERVAL or np.ptp(values) == 0:
        return values.min(), values.max()
    low, high = student_t.interval(0.95, len(values) - 1, values.mean(), values.std(ddof=1) / np.sqrt(len(values)))
    hall_low, hall_high = hall_limits(values)
    return min(low, hall_low), max(high, hall_high)


def all_sums(d):
    """Sums of s_i d_i over all patterns of signs, ascending."""
    sums = np.zeros(1)
    for value in d:
        sums = np.concatenate([sums - value, sums + value])
    return np.sort(sums)


def share_by_counting(d, noise=0.0):
    """Share of the 2^n patterns with a sum as far from 0 as that of d, less the noise; each half against the other."""
    d = d[d != 0]
    left, right = all_sums(d[::2]), all_sums(d[1::2])
    limit = abs(d.sum()) - 2.0**-30 * np.abs(d).sum() - noise
    below = np.searchsorted(right, -limit - left, side="right")
    above = len(right) - np.searchsorted(right, limit - left, side="left")
    return 1.0 if limit <= 0 else (below + above).sum() / (len(left) * len(right))


def sign_flip_p(a, b, digit):
    """(p, by how much the program's may differ); p is None where several seeds have the same values.

    It may differ by five standard errors where patterns are drawn, and where values known to a digit alone make ties.
    """
    a, b = np.asarray(a, float), np.asarray(b, float)
    d, n = a - b, np.count_nonzero(a - b)
    if len(d) > 1 and np.ptp(a) == 0 and np.ptp(b) == 0:
        return None, 0.0
    if n == 0:
        return 1.0, 0.0
    p, noise = share_by_counting(d), digit * n
    ties = max(share_by_counting(d, noise) - p, p - share_by_counting(d, -noise)) if noise else 0.0
    if 1 < len(d) <= MOST_FOR_SCIPY:
        test = permutation_test((a, b), lambda x, y, axis: (x - y).mean(axis=axis), permutation_type="samples",
                                vectorized=True, n_resamples=np.inf, batch=4096)
        return test.pvalue, ties
    return p, ties + (5 * np.sqrt(p * (1 - p) / PATTERNS) + 1 / PATTERNS if n > MOST_FOR_EXACT else 0.0)


def holm(ps):
    """k-th smallest of m times m - k + 1, at most 1, never falling; a row without p counts nowhere."""
    result, last = [None] * len(ps), 0.0
    known = sorted((n for n, p in enumerate(ps) if p is not None), key=lambda n: ps[n])
    for k, number in enumerate(known):
        last = max(last, min(1.0, ps[number] * (len(known) - k)))
        result[number] = last
    return result
