#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""How often `mapscore calibrate` is right, how often its region is, and whether it is ever worse than its start.

Run by hand, for an hour each. Needs numpy, scipy, yaml.

    tests/end_to_end/calibration_draws.py build/release/mapscore FOLDER drives [--draws 500]
    tests/end_to_end/calibration_draws.py build/release/mapscore FOLDER seeds [--draws 200]

  drives  a random drive of a home each (nine places that follow each other on the drive of configs/rivals.yaml, moved
          by up to 5 cm, random headings), of it 3 to 20 successive frames or every second one. Starts are .1 to 60 mm
          and .005 to 4 degrees off, seven draws in ten have noise. Exits with 1 if a draw is worse than its start
          without a note that it may be.
  seeds   20 frames of the drive of configs/rivals.yaml, noise drawn anew each time, starts exactly 60 mm and 4 degrees
          off

Noise is an Astra's depth, masks ragged by 1.5 px, 10 % missed and 3 % of another class. A calibration's error is how
far it moves the pixels of a grid at 1, 2 and 4 m, on average. Prints a table, and writes each draw to FOLDER/MODE.csv.
"""

import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, fields

import numpy as np
import yaml
from scipy.spatial.transform import Rotation

SOURCE = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
HOMES = ("home", "cottage")
NOISE = {"depth": {"preset": "astra"}, "labels": {"ragged_px": 1.5, "miss": 0.1, "confusion": 0.03}}
NOISY = 0.7
PLACES, MOVED_M, FRAMES_PER_S = 9, 0.05, 0.9
START_M, START_DEG = (1e-4, 0.06), (0.005, 4)
REGION_95 = 12.592  # of chi squared with six degrees of freedom


@dataclass
class Draw:
    home: str
    number: int
    noise: int  # 1 with noise
    frames: str
    start_mm: float = 0
    start_deg: float = 0
    start_px: float = 0
    verdict: str = ""
    note: int = 0  # 1: the estimate may be worse
    found_mm: float = float("nan")
    found_deg: float = float("nan")
    found_px: float = float("nan")
    squares: float = float("nan")  # of the error in units of the stated covariance

    def known(self):
        return self.verdict in ("calibrated", "confirmed")

    def worse(self):
        return self.known() and self.found_px > self.start_px * (1 + 1e-9)


def run(*arguments, may_say_no=False):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0 and not (may_say_no and done.returncode == 1):
        raise RuntimeError(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def whole_drive(home):
    with open(os.path.join(SOURCE, "configs", "rivals.yaml"), encoding="utf-8") as file:
        return yaml.safe_load(file)["scenes"][home]["trajectory"]


def random_drive(home, random):
    way = np.array(whole_drive(home)["waypoints_m_deg"])
    first = random.integers(len(way) - PLACES + 1)
    places = way[first:first + PLACES][::random.choice([-1, 1])].copy()
    places[:, :2] += random.uniform(-MOVED_M, MOVED_M, (PLACES, 2))
    places[:, 2] = random.uniform(-180, 180, PLACES)
    return {"waypoints_m_deg": places.round(3).tolist(), "frames_per_s": FRAMES_PER_S}


class Drive:
    """Recording and noisy trials of one drive, each made once."""

    def __init__(self, flags, name, home, trajectory, seeds):
        self.mapscore, self.folder = flags.mapscore, os.path.join(flags.folder, name)
        os.makedirs(self.folder, exist_ok=True)
        self.study = os.path.join(self.folder, "study.yaml")
        study = {"name": "calibration_draws", "scene": os.path.join(SOURCE, "scenes", f"{home}.xml"),
                 "trajectory": trajectory, "faults": NOISE, "seeds": seeds,
                 "methods": {"direct": {"segmentation": {"direct": {}}}}}
        with open(self.study, "w", encoding="utf-8") as file:
            json.dump(study, file)

    def made(self, name, *arguments):
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            run(self.mapscore, *arguments, "-o", path, "-q")
        return path

    def recording(self):
        return self.made("recording", "record", self.study)

    def trial(self, seed):
        return self.made(f"trial_{seed}", "trial", self.study, "--seed", seed, "--set",
                         f"recording={self.recording()}")


def pose(numbers):
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_quat(numbers[3:]).as_matrix()
    matrix[:3, 3] = numbers[:3]
    return matrix


def numbers_of(matrix):
    return [*matrix[:3, 3].tolist(), *Rotation.from_matrix(matrix[:3, :3]).as_quat().tolist()]


def cameras_of(folder):
    with open(os.path.join(folder, "recording.yaml"), encoding="utf-8") as file:
        return yaml.safe_load(file)


def moved_px(cameras, truth, believed):
    """How far the believed calibration moves pixels of a grid at 1, 2 and 4 m, on average."""
    depth, color = cameras["depth"], cameras["color"]
    u, v = np.meshgrid(np.linspace(0, depth["width_px"] - 1, 17), np.linspace(0, depth["height_px"] - 1, 13))
    rays = np.stack([(u - depth["cx_px"]) / depth["fx_px"], (v - depth["cy_px"]) / depth["fy_px"],
                     np.ones_like(u)], -1).reshape(-1, 3)
    points = np.concatenate([rays * z for z in (1, 2, 4)])

    def pixels(transform):
        seen = points @ transform[:3, :3].T + transform[:3, 3]
        return seen[:, :2] / seen[:, 2:] * [color["fx_px"], color["fy_px"]]

    return float(np.linalg.norm(pixels(believed) - pixels(truth), axis=1).mean())


def of_length(length, random):
    direction = random.normal(size=3)
    return direction * (length / np.linalg.norm(direction))


def error_of(truth, found):
    off = found @ np.linalg.inv(truth)
    return (1000 * np.linalg.norm(off[:3, 3]),
            np.degrees(Rotation.from_matrix(off[:3, :3]).magnitude()))


def calibrate(mapscore, images, recording, draw, error, more):
    """Fills in what the program finds from a start that is wrong by `error` (4 x 4, after the true T_color_depth)."""
    cameras = cameras_of(recording)
    truth = pose(cameras["T_color_depth"])
    start = error @ truth
    draw.start_mm, draw.start_deg = error_of(truth, start)
    draw.start_px = moved_px(cameras, truth, start)
    wrong, output = images + ".start.yaml", images + ".found.yaml"
    with open(wrong, "w", encoding="utf-8") as file:
        json.dump({"T_color_depth": numbers_of(start)}, file)
    said = run(mapscore, "calibrate", images, "--start", wrong, "-o", output, "-q", *more, may_say_no=True)
    draw.verdict = next(line.split(":")[0] for line in said.splitlines()[1:] if ":" in line)
    if os.path.exists(output):
        with open(output, encoding="utf-8") as file:
            result = yaml.safe_load(file)
        estimate = result["estimate"]
        found = pose(result["T_color_depth"])
        draw.verdict, draw.note = estimate["verdict"], int(estimate.get("may_be_worse", False))
        draw.found_mm, draw.found_deg = error_of(truth, found)
        draw.found_px = moved_px(cameras, truth, found)
        change = truth @ np.linalg.inv(start)
        right = np.concatenate([Rotation.from_matrix(change[:3, :3]).as_rotvec(), change[:3, 3]])
        off = np.array(estimate["change"]) - right
        covariance = np.array(estimate["covariance"], dtype=float).reshape(6, 6)
        draw.squares = float(off @ np.linalg.solve(covariance, off))
        os.remove(output)
    os.remove(wrong)
    return draw


def wrong_by(shift_m, turn_rad, random):
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_rotvec(of_length(turn_rad, random)).as_matrix()
    matrix[:3, 3] = of_length(shift_m, random)
    return matrix


def drive_of(flags, home, number, random):
    """A draw of a random drive of its own."""
    noise = bool(random.random() < NOISY)
    drive = Drive(flags, f"{home}_{number}", home, random_drive(home, random), number + 1)
    recording = drive.recording()
    with open(os.path.join(recording, "color.txt"), encoding="utf-8") as file:
        count = sum(not line.startswith("#") for line in file)
    step = int(random.integers(1, 3))
    frames = int(random.integers(3, 21))
    first = int(random.integers(max(1, count - step * (frames - 1))))
    chosen = f"{first}:{min(count, first + step * frames)}:{step}"
    error = wrong_by(np.exp(random.uniform(*np.log(START_M))),
                     np.radians(np.exp(random.uniform(*np.log(START_DEG)))), random)
    draw = Draw(home, number, int(noise), chosen)
    try:
        calibrate(flags.mapscore, drive.trial(number) if noise else recording, recording, draw, error,
                  ["--frames", chosen])
    except RuntimeError as refused:
        if "none has a label image that shows an object" not in str(refused):
            raise
        draw.verdict = "no object"
    shutil.rmtree(drive.folder)
    return draw


def seed_of(flags, home, number, random):
    """A draw of the noise of a home's whole drive."""
    drive = Drive(flags, f"whole_{home}", home, whole_drive(home), flags.seed + flags.draws)
    images = drive.trial(flags.seed + number)
    error = wrong_by(START_M[1], np.radians(START_DEG[1]), random)
    draw = calibrate(flags.mapscore, images, drive.recording(), Draw(home, number, 1, "all"), error,
                     ["--most_frames", 20])
    shutil.rmtree(images)
    return draw


def draws_of(flags):
    one = {"drives": drive_of, "seeds": seed_of}[flags.mode]
    todo = [(home, number) for number in range(flags.draws) for home in HOMES]
    if flags.mode == "seeds":
        for home in HOMES:
            Drive(flags, f"whole_{home}", home, whole_drive(home), 1).recording()
    draws = []
    with ThreadPoolExecutor(flags.jobs) as pool:
        for draw in pool.map(lambda of: one(flags, *of, np.random.default_rng(
                [flags.seed, HOMES.index(of[0]), of[1]])), todo):
            draws.append(draw)
            print(f"\r{len(draws)} of {len(todo)} draws", end="", file=sys.stderr)
    print(file=sys.stderr)
    return draws


def summary(draws):
    lines = ["home     noise draws calibrated confirmed refused |  mean mm  degrees | region | may be worse, worse, of these unsaid"]
    for home in HOMES:
        for noise in (0, 1):
            group = [d for d in draws if d.home == home and d.noise == noise]
            if not group:
                continue
            known = [d for d in group if d.known()]
            count = {v: sum(d.verdict == v for d in group) for v in ("calibrated", "confirmed")}
            worse = [d for d in known if d.worse()]
            lines.append(f"{home:8} {noise:5} {len(group):5} {count['calibrated']:10} {count['confirmed']:9} "
                         f"{len(group) - len(known):7} | {np.mean([d.found_mm for d in known]):8.3f} "
                         f"{np.mean([d.found_deg for d in known]):8.4f} | "
                         f"{np.mean([d.squares <= REGION_95 for d in known]):6.3f} | "
                         f"{sum(d.note for d in known)}, {len(worse)}, {sum(not d.note for d in worse)}")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mapscore")
    parser.add_argument("folder")
    parser.add_argument("mode", choices=("drives", "seeds"))
    parser.add_argument("--draws", type=int, help="of each home [500 of drives, 200 of seeds]")
    parser.add_argument("--seed", type=int, default=0, help="other seeds, other draws [0]")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="programs at once [all cores]")
    flags = parser.parse_args()
    if flags.draws is None:
        flags.draws = {"drives": 500, "seeds": 200}[flags.mode]
    if flags.draws < 1 or flags.jobs < 1 or flags.seed < 0:
        parser.error("--draws and --jobs: from 1 on; --seed: from 0 on")
    if not os.access(flags.mapscore, os.X_OK):
        parser.error(f"{flags.mapscore}: is no program; build mapscore first")
    try:
        os.makedirs(flags.folder, exist_ok=True)
        draws = draws_of(flags)
    except (RuntimeError, OSError) as refused:
        parser.exit(2, f"{parser.prog}: {refused}\n")
    with open(os.path.join(flags.folder, f"{flags.mode}.csv"), "w", encoding="utf-8", newline="") as file:
        rows = csv.DictWriter(file, [field.name for field in fields(Draw)])
        rows.writeheader()
        rows.writerows(asdict(draw) for draw in draws)
    print(summary(draws))
    return int(any(draw.worse() and not draw.note for draw in draws))


if __name__ == "__main__":
    sys.exit(main())
