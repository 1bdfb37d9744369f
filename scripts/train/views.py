# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Viewpoints near the committed drive of a home: other headings, heights and tilts, from a seed."""

import math

import numpy as np

ROBOT_HEIGHT_M, ROBOT_TILT_DEG, AHEAD_M = 1.15, 12, 0.05   # scenes/robot.xml


def along(waypoints, fraction):
    """x, y and heading (degrees) at a fraction of the drive's length in waypoints."""
    n = min(int(fraction * (len(waypoints) - 1)), len(waypoints) - 2)
    t = fraction * (len(waypoints) - 1) - n
    a, b = np.array(waypoints[n], float), np.array(waypoints[n + 1], float)
    turn = (b[2] - a[2] + 180) % 360 - 180
    return a[:2] + t * (b[:2] - a[:2]), a[2] + t * turn


def quaternion(yaw, pitch, roll):
    """x, y, z, w of the optical frame (z ahead, x right) of a camera; radians, pitch downwards."""
    cy, sy, cp, sp, cr, sr = (f(v) for v in (yaw, pitch, roll) for f in (math.cos, math.sin))
    ahead = np.array([cy * cp, sy * cp, -sp])
    right = np.array([sy, -cy, 0.0])
    down = np.cross(ahead, right)
    x, y = cr * right + sr * down, cr * down - sr * right
    return from_matrix(np.stack([x, y, ahead], 1))


def from_matrix(R):
    """x, y, z, w of a rotation matrix: the eigenvector of Bar-Itzhack's matrix."""
    (a, b, c), (d, e, f), (g, h, i) = R
    K = np.array([[a - e - i, b + d, c + g, h - f], [b + d, e - a - i, f + h, c - g],
                  [c + g, f + h, i - a - e, d - b], [h - f, c - g, d - b, a + e + i]]) / 3
    return np.linalg.eigh(K)[1][:, 3]


def views(waypoints, count, seed):
    """`stamp tx ty tz qx qy qz qw` lines of the colour camera, one a second."""
    random, lines = np.random.default_rng(seed), []
    for n in range(count):
        place, heading = along(waypoints, random.random())
        place = place + np.clip(random.normal(0, 0.15, 2), -0.3, 0.3)
        yaw = heading + random.normal(0, 30) if random.random() < 0.6 else random.uniform(0, 360)
        as_robot = random.random() < 0.6
        height = ROBOT_HEIGHT_M if as_robot else random.uniform(0.7, 1.6)
        tilt = ROBOT_TILT_DEG if as_robot else random.uniform(-15, 28)
        roll = 0 if as_robot else random.normal(0, 1.5)
        yaw, tilt, roll = (math.radians(v) for v in (yaw, tilt, roll))
        place = place + AHEAD_M * np.array([math.cos(yaw), math.sin(yaw)])
        pose = [*place, height, *quaternion(yaw, tilt, roll)]
        lines.append(" ".join([f"{n:.1f}", *(f"{v:.6f}" for v in pose)]))
    return "\n".join(lines) + "\n"
