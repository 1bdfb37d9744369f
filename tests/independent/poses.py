# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Believed poses and the draws from a pose belief, by docs/methods.md and docs/fusion.md."""

import numpy as np

from segmentation import cross_product, exponential
from streams import Stream


def exponential_pose(xi):
    """4 x 4 matrix of xi = (rho, omega), the exponential of SE(3)."""
    rho, omega = np.asarray(xi[:3], float), np.asarray(xi[3:], float)
    result, theta = np.eye(4), np.linalg.norm(omega)
    result[:3, 3] = rho
    if theta > 0:
        W = cross_product(omega)
        result[:3, :3] = exponential(omega)
        result[:3, 3] += ((1 - np.cos(theta)) / theta**2 * W + (theta - np.sin(theta)) / theta**3 * W @ W) @ rho
    return result


def covariance(keys):
    """Of one draw of faults.pose: x, y, z, roll, pitch, yaw."""
    xy, z, yaw = (keys.get(name, 0) for name in ("sigma_xy_m", "sigma_z_m", "sigma_yaw_deg"))
    tilt = keys.get("sigma_roll_pitch_deg", 0)
    sigmas = np.array([xy, xy, z, *np.radians([tilt, tilt, yaw])])
    E = np.array(keys["covariance_m_rad"], float) if "covariance_m_rad" in keys else np.diag(sigmas**2)
    return keys.get("sigma_scale", 1)**2 * E


def root(E):
    """Cholesky's lower triangular root, column by column; a column is 0 where the axes before determine it."""
    L = np.zeros_like(E)
    for j in range(len(E)):
        pivot = E[j, j] - (L[j, :j]**2).sum()
        if pivot > 1e-14 * E[j, j]:
            L[j, j] = np.sqrt(pivot)
            L[j + 1:, j] = (E[j + 1:, j] - L[j + 1:, :j] @ L[j, :j]) / L[j, j]
    return L


def believed_poses(true_poses, keys, seed):
    """T_map_base that each frame believes; keys: of faults.pose."""
    L, kind, error, result = root(covariance(keys)), keys.get("kind", "white"), np.eye(4), []
    for frame, pose in enumerate(true_poses):
        drawn = exponential_pose(L @ Stream(seed, "pose", 0 if kind == "constant" else frame).normals(6))
        error = error @ drawn if kind == "walk" else drawn
        result.append(pose @ error)
    return result


def drawn_poses(believed, E, fusion, seed, frame):
    """The N poses at which an observation is placed; E: the reported covariance; odom is the map."""
    L = root(E if fusion.get("covariance", "diagonal") == "full" else np.diag(np.diag(E)))
    normals = Stream(seed, "belief", frame).normals(6 * fusion.get("N", 1)).reshape(-1, 6)
    drawn = [exponential_pose(L @ column) for column in normals]
    return [move @ believed if fusion.get("noise_at", "base") == "odom" else believed @ move for move in drawn]
