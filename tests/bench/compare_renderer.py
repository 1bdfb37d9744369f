#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Recorded frames a second of the large home, two cores: `mapscore record` and MuJoCo's own Python Renderer.

    tests/bench/compare_renderer.py build/release/mapscore [--frames 96] [--repetitions 3]

Run by hand on a machine that does nothing else; it installs MuJoCo's Python package, NumPy and OpenCV into
build/renderer_env. Both draw the same images of the same scene at the same poses (colour and labels from the colour
camera, depth and labels from the depth camera, 640 x 480), once without and once with shadows, and write them as PNGs. Time of
ours is that of the whole program, loading included; Python's is that of its loop alone, in two processes, warmed up.
"""

import argparse
import math
import os
import resource
import shutil
import subprocess
import sys
import time
import venv

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.join(HERE, "..", "..")
SCENE, ROBOT = (os.path.join(SOURCE, "scenes", name) for name in ("home.xml", "robot.xml"))
# MuJoCo's release in build/deps is 4.0.1, of which there are no Python bindings: 4.0.0 are the nearest.
PACKAGES = ["mujoco==4.0.0", "numpy", "opencv-python-headless"]
WORKERS = 2
LEVEL = 1  # of deflate: ours, files/png.cpp
BAR_RATIO = 1.5
BAR_FRAMES_PER_S = {0: 15, 1: 8}
# Base poses x, y (m), yaw (degrees) in all rooms of the home.
TOUR = [(5.4, 1.2, 75), (5.4, 3.1, 95), (4.0, 3.1, 205), (3.9, 1.4, 150), (3.6, 0.9, 200), (3.6, 0.9, 8), (4.0, 3.1, 140),
        (2.7, 3.65, 170), (1.6, 3.65, 200), (1.6, 3.65, 0), (2.7, 5.1, 160), (2.45, 6.2, 235), (2.45, 6.2, 85),
        (3.6, 5.4, 115), (3.6, 5.4, -62), (5.25, 5.4, 60), (5.25, 4.9, -80), (6.9, 3.8, 50), (7.9, 4.1, -30), (7.9, 4.1, 70),
        (6.9, 3.9, -80), (5.4, 3.7, -90), (5.4, 1.4, 0), (7.3, 1.25, 50), (8.0, 1.2, 215), (8.0, 1.2, 120)]


def interpreter():
    """Of an environment that has PACKAGES; made once."""
    folder = os.path.join(SOURCE, "build", "renderer_env")
    python, marker = os.path.join(folder, "bin", "python"), os.path.join(folder, "complete")
    if not os.path.exists(marker):
        venv.create(folder, with_pip=True, clear=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "--disable-pip-version-check", *PACKAGES], check=True)
        open(marker, "w", encoding="utf-8").close()
    return python


def tour(frames):
    """Poses at even steps along TOUR, a line each; headings turn the short way."""
    lines = []
    for frame in range(frames):
        at = frame * (len(TOUR) - 1) / max(1, frames - 1)
        leg = min(int(at), len(TOUR) - 2)
        (x0, y0, yaw0), (x1, y1, yaw1) = TOUR[leg], TOUR[leg + 1]
        turn = (yaw1 - yaw0 + 180) % 360 - 180
        t = at - leg
        lines.append(f"{x0 + t * (x1 - x0)} {y0 + t * (y1 - y0)} {yaw0 + t * turn}\n")
    return "".join(lines)


def children_s():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Bench:
    def __init__(self, mapscore, folder, frames):
        self.mapscore, self.folder, self.frames = mapscore, folder, frames
        self.python = [interpreter(), "-B", os.path.join(HERE, "python_renderer.py")]
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        self.recording, self.theirs = os.path.join(folder, "recording"), os.path.join(folder, "python")
        poses = subprocess.run([*self.python, "poses", SCENE, ROBOT], input=tour(frames), capture_output=True, text=True,
                               check=True).stdout
        self.trajectories = {}
        for count in (1, frames):
            self.trajectories[count] = os.path.join(folder, f"poses_{count}.txt")
            with open(self.trajectories[count], "w", encoding="utf-8") as text:
                text.write("".join(poses.splitlines(keepends=True)[:count]))
        self.record(1, 0)  # so that poses can be read, and files are in memory
        self.record(frames, 0)
        self.workers = [subprocess.Popen([*self.python, "draw", SCENE, ROBOT, self.recording, self.theirs, str(worker),
                                          str(WORKERS)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
                        for worker in range(WORKERS)]
        self.wait_for("ready")

    def record(self, count, shadows):
        """What the program takes: seconds, and seconds of the processors."""
        shutil.rmtree(self.recording, ignore_errors=True)
        started, busy = time.perf_counter(), children_s()
        subprocess.run([self.mapscore, "record", SCENE, "--trajectory", self.trajectories[count], "-o", self.recording, "-q",
                        "--jobs", str(WORKERS), "--set", f"cameras.shadows={'true' if shadows else 'false'}"], check=True)
        return time.perf_counter() - started, children_s() - busy

    def draw(self, level, shadows):
        """What the Python processes take, as record."""
        started = time.perf_counter()
        for worker in self.workers:
            worker.stdin.write(f"{level} {shadows}\n")
            worker.stdin.flush()
        busy = self.wait_for("done")
        return time.perf_counter() - started, busy

    def wait_for(self, word):
        """Sum of the numbers that the workers say after it."""
        total = 0.0
        for worker in self.workers:
            said, *numbers = worker.stdout.readline().split() or [""]
            if said != word:
                raise SystemExit("python_renderer.py failed")
            total += sum(float(number) for number in numbers)
        return total

    def compare(self):
        text = subprocess.run([*self.python, "compare", self.recording, self.theirs], capture_output=True, text=True,
                              check=True).stdout
        for line in text.splitlines():
            channel, most, share, ours, theirs = line.split()
            print(f"    {channel:<12} {float(share):8.4%} of pixels within {most}; "
                  f"{float(ours) / 1000:.0f} kB an image, Python's {float(theirs) / 1000:.0f} kB")

    def close(self):
        for worker in self.workers:
            worker.stdin.close()
            worker.wait()
        shutil.rmtree(self.folder)


def against(value, bar):
    return f"(bar {bar}: {'met' if value >= bar else 'MISSED'})"


def measure(bench, shadows, repetitions):
    runs = {"start": lambda: bench.record(1, shadows), "level": lambda: bench.draw(LEVEL, shadows),
            "default": lambda: bench.draw(-1, shadows), "ours": lambda: bench.record(bench.frames, shadows)}
    best, busy = dict.fromkeys(runs, math.inf), dict.fromkeys(runs, math.inf)
    for _ in range(repetitions):
        for name, run in runs.items():
            seconds, busy_s = run()
            best[name], busy[name] = min(best[name], seconds), min(busy[name], busy_s)
    rate = {name: bench.frames / seconds for name, seconds in best.items()}
    # Python's loop is warm, so the ratio leaves our start-up and one frame out.
    warm = (bench.frames - 1) / (best["ours"] - best["start"])
    warm_busy = (busy["ours"] - busy["start"]) / (bench.frames - 1)
    ratios = {name: (warm / rate[name], busy[name] / bench.frames / warm_busy) for name in ("level", "default")}
    print(f"{'with' if shadows else 'without'} shadows, best of {repetitions}; processor time counts both cores:")
    print(f"    mapscore record            {rate['ours']:6.2f} frames/s {against(rate['ours'], BAR_FRAMES_PER_S[shadows])}, "
          f"{1000 * busy['ours'] / bench.frames:.0f} ms of processor a frame; {best['ours']:.2f} s in all; after "
          f"start-up and a frame ({best['start']:.2f} s) {warm:.2f} frames/s, {1000 * warm_busy:.0f} ms")
    for name, title in (("level", f"Python, PNG level {LEVEL}"), ("default", "Python, PNG as OpenCV")):
        bar = against(ratios[name][0], BAR_RATIO) if name == "level" else ""
        print(f"    {title:<26} {rate[name]:6.2f} frames/s, {1000 * busy[name] / bench.frames:.0f} ms of processor a frame; "
              f"ratio {ratios[name][0]:.2f} {bar}, of processor time {ratios[name][1]:.2f}")
    bench.compare()
    return rate["ours"] >= BAR_FRAMES_PER_S[shadows] and ratios["level"][0] >= BAR_RATIO


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mapscore")
    parser.add_argument("--frames", type=int, default=96)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--folder", default=os.path.join(SOURCE, "build", "compare_renderer"))
    arguments = parser.parse_args()
    bench = Bench(os.path.abspath(arguments.mapscore), arguments.folder, arguments.frames)
    print(f"{arguments.frames} frames of 640 x 480, four images each, {WORKERS} workers each; {' '.join(PACKAGES)}")
    met = [measure(bench, shadows, arguments.repetitions) for shadows in (0, 1)]
    bench.close()
    return 0 if all(met) else 1


if __name__ == "__main__":
    sys.exit(main())
