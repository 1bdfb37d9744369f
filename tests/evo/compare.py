#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds ATE and RPE of mapscore against those of evo, to 1e-9: on trajectories made here, and on those of every
pose source along a short drive on wheels through the home.

    tests/evo/compare.py build/release build/deps/evo-1.38.1 FOLDER     # exit 1 with every figure that differs

evo is fetched by scripts/setup.sh --ci; of it evo.core alone is used, which needs numpy and scipy.
"""

import csv
import pathlib
import shutil
import subprocess
import sys

import numpy as np
from scipy.spatial.transform import Rotation

ROOT = pathlib.Path(__file__).resolve().parents[2]
SLACK = 1e-9

STUDY = """
scene: {scene}
trajectory:
  drive: {{wheels: {{}}}}
  waypoints_m_deg: [[5.413, 1.203, 75], [5.413, 3.093, 95], [4.013, 3.093, 205], [3.897, 1.413, 150]]
cameras: {{width_px: 64, height_px: 48}}
methods: {{direct: {{segmentation: {{direct: {{}}}}}}}}
"""


def tum_text(stamps, rotations, positions):
    """One line a pose; numbers are the shortest texts that read back the same."""
    lines = []
    for stamp, turn, place in zip(stamps, rotations.as_quat(), positions):
        lines.append(" ".join(repr(float(number)) for number in (stamp, *place, *turn)))
    return "\n".join(lines) + "\n"


def read_tum(file):
    numbers = np.loadtxt(file, comments="#", ndmin=2)
    return numbers[:, 0], numbers[:, 1:4], numbers[:, 4:8]


def trajectory(evo, file):
    _, positions, xyzw = read_tum(file)
    return evo.trajectory.PosePath3D(positions_xyz=positions, orientations_quat_wxyz=xyzw[:, [3, 0, 1, 2]])


def rmse(evo, metric, truth, believed):
    metric.process_data((truth, believed))
    return metric.get_statistic(evo.metrics.StatisticsType.rmse)


def evo_figures(evo, truth_file, believed_file):
    """Figures by their names in localization_scores.csv, and how many pairs RPE has."""
    kinds = evo.metrics.PoseRelation
    truth, believed = trajectory(evo, truth_file), trajectory(evo, believed_file)
    figures = {"ate_m": rmse(evo, evo.metrics.APE(kinds.translation_part), truth, believed),
               "ate_deg": rmse(evo, evo.metrics.APE(kinds.rotation_angle_deg), truth, believed)}
    for name, kind, units in (("rpe_percent", kinds.translation_part, 100.0),
                              ("rpe_deg_per_m", kinds.rotation_angle_deg, 1.0)):
        metric = evo.metrics.RPE(kind, delta=1.0, delta_unit=evo.units.Unit.meters, rel_delta_tol=0.1,
                                 all_pairs=True, pairs_from_reference=True)
        try:
            figures[name] = units * rmse(evo, metric, truth, believed)
            figures["pairs"] = len(metric.delta_ids)
        except evo.filters.FilterException:
            figures["pairs"] = 0
    believed.align(truth)
    figures["ate_aligned_m"] = rmse(evo, evo.metrics.APE(kinds.translation_part), truth, believed)
    return figures


def differences(name, theirs, ours):
    """Lines that say which figure of which trajectory differs, or is there with one of both alone."""
    compared = {key: value for key, value in ours.items() if not key.startswith("nees")}
    if theirs.keys() != compared.keys():
        return [f"{name}: evo has {sorted(theirs)}, mapscore {sorted(compared)}"]
    return [f"{name}: {key}: evo {theirs[key]!r}, mapscore {compared[key]!r}"
            for key in theirs if not abs(theirs[key] - compared[key]) <= SLACK]


def walk(random, steps, step_m, turn_rad, plane):
    """A smooth way: rotations and positions; in the plane, or turning about all axes."""
    axes = np.array([0.0, 0.0, 1.0]) if plane else np.ones(3)
    turns = np.cumsum(random.normal(0.0, turn_rad, (steps, 3)) * axes, axis=0)
    rotations = Rotation.identity(steps)
    motions = [Rotation.identity()]
    for turn in np.diff(turns, axis=0):
        motions.append(motions[-1] * Rotation.from_rotvec(turn))
    rotations = Rotation.concatenate(motions)
    ahead = rotations.apply([1.0, 0.0, 0.0]) * step_m
    return rotations, np.cumsum(ahead, axis=0)


def drifted(random, rotations, positions, sigma_m, sigma_rad):
    """What an odometry with noise in every step would believe."""
    place, turn = positions[0], rotations[0]
    places, turns = [place], [turn]
    for n in range(1, len(positions)):
        step = rotations[n - 1].inv()
        place = place + turn.apply(step.apply(positions[n] - positions[n - 1]) + random.normal(0.0, sigma_m, 3))
        turn = turn * (step * rotations[n]) * Rotation.from_rotvec(random.normal(0.0, sigma_rad, 3))
        places.append(place)
        turns.append(turn)
    return Rotation.concatenate(turns), np.array(places)


def scattered(random, rotations, positions, sigma_m, sigma_rad):
    count = len(positions)
    return (rotations * Rotation.from_rotvec(random.normal(0.0, sigma_rad, (count, 3))),
            positions + random.normal(0.0, sigma_m, (count, 3)))


def square(side_m, step_m):
    """Exact steps, so that two poses are as near to a metre of way as each other."""
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]) * side_m
    places, yaws = [], []
    for (start, end), yaw in zip(zip(corners, corners[1:]), (0.0, 90.0, 180.0, 270.0)):
        for share in np.arange(0.0, 1.0, step_m / side_m):
            places.append([*(start + share * (end - start)), 0.0])
            yaws.append(yaw)
    return Rotation.from_euler("z", yaws, degrees=True), np.array(places)


def made_trajectories():
    """Name, truth, belief."""
    random = np.random.default_rng(20)
    for plane in (True, False):
        truth = walk(random, 400, 0.04, 0.1, plane)
        name = "plane" if plane else "space"
        yield f"{name}, drift", truth, drifted(random, *truth, 2e-3, 1e-3)
        yield f"{name}, scatter", truth, scattered(random, *truth, 0.02, 0.01)
    rotations, positions = walk(random, 300, 0.03, 0.05, True)
    standing = np.repeat(np.arange(300), random.integers(1, 6, 300))
    stops = (rotations[standing], positions[standing])
    yield "standing", stops, scattered(random, *stops, 0.01, 0.005)
    for step_m in (0.25, 0.125, 2.0 / 3.0):
        truth = square(4.0, step_m)
        yield f"square, steps of {step_m:.3f} m", truth, drifted(random, *truth, 3e-3, 2e-3)
    truth = walk(random, 200, 0.05, 0.1, False)
    turn = Rotation.from_euler("xyz", [10, 170, -80], degrees=True)
    yield "moved", truth, (turn * truth[0], turn.apply(truth[1]) + [900.0, -700.0, 50.0])
    yield "scaled", truth, (truth[0], truth[1] * 1.05)
    sparse = walk(random, 120, 0.31, 0.2, True)
    yield "sparse", sparse, scattered(random, *sparse, 0.05, 0.05)
    lost = walk(random, 150, 0.05, 0.1, True)
    yield "lost", lost, scattered(random, *lost, 10.0, 2.0)


def check_made(evo, program, folder):
    """Figures of trajectories made here; returns the differences and how many trajectories there were."""
    found, count = [], 0
    for name, truth, believed in made_trajectories():
        stamps = 0.1 * np.arange(len(truth[1]))
        files = [folder / f"made_{count}_{what}.txt" for what in ("truth", "believed")]
        for file, poses in zip(files, (truth, believed)):
            file.write_text(tum_text(stamps, *poses))
        text = subprocess.run([program, *files], check=True, capture_output=True, text=True).stdout
        ours = {key: float(value) for key, value in (word.split("=") for word in text.strip().split(","))}
        found += differences(name, evo_figures(evo, *files), ours)
        count += 1
    return found, count


def recording_of(mapscore, folder):
    study = folder / "drive.yaml"
    study.write_text(STUDY.format(scene=ROOT / "scenes/home.xml"))
    recording = folder / "recording"
    subprocess.run([mapscore, "record", study, "-o", recording, "-q"], check=True)
    return recording


def check_recorded(evo, mapscore, folder):
    """Figures of every source along a recorded drive, as `localize` writes them."""
    recording, localized = recording_of(mapscore, folder), folder / "localized"
    subprocess.run([mapscore, "localize", recording, "-o", localized, "--source", "all", "-q"], check=True,
                   capture_output=True)
    found, count = [], 0
    with open(localized / "localization_scores.csv", newline="") as lines:
        for row in csv.DictReader(lines):
            source = row.pop("source")
            ours = {key: float(value) for key, value in row.items() if key not in ("seed", "frames") and value != "-"}
            theirs = evo_figures(evo, localized / "truth_at_frames.txt", localized / f"{source}_at_frames.txt")
            found += differences(source, theirs, ours)
            count += 1
    return found, count


def main(build, evo_folder, folder):
    sys.path.insert(0, str(pathlib.Path(evo_folder).resolve()))
    import evo.core.filters  # noqa: E402
    import evo.core.metrics  # noqa: E402
    import evo.core.trajectory  # noqa: E402
    import evo.core.units  # noqa: E402
    build, folder = pathlib.Path(build).resolve(), pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    made, made_count = check_made(evo.core, build / "mapscore_pose_errors", folder)
    recorded, recorded_count = check_recorded(evo.core, build / "mapscore", folder)
    for line in made + recorded:
        print(line)
    print(f"evo: {made_count} made and {recorded_count} recorded trajectories, {len(made + recorded)} differences")
    return 1 if made + recorded or recorded_count < 2 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
