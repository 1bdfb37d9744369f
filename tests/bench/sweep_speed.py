#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What a trial of the demo costs, and what a second job gains.

    tests/bench/sweep_speed.py build/release/mapscore FOLDER [--seeds 67]

In one run, on a machine that does nothing else:

  anew        records the demo's drive, makes the truth and scores a single trial (with its lattice ceiling), one job
  one job     the demo's sweep with so many seeds (67: 1005 trials and 67 ceilings) of that recording
  two jobs    the same
  two at once two sweeps of one job each, in folders of their own: what the hardware gives to two programs that share
              nothing. Two hyperthreads of one core give less than 2.

Bars: 1000 trials in 4 minutes with two jobs; wall time of one job over that of two at least 1.8, or the share of it that
two programs reach; a trial at least 50 times cheaper than anew, in processor time.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DEMO = os.path.join(SOURCE, "configs", "demo.yaml")


def single_study(folder):
    """The demo with one method and no fault."""
    with open(DEMO, encoding="utf-8") as file:
        text = file.read()
    text = text.replace("../scenes/", os.path.join(os.path.realpath(SOURCE), "scenes", ""))
    text = re.sub(r"(?m)^  (direct|region_growing): .*\n", "", text)
    text = re.sub(r"(?ms)^sweep:.*?^seeds: .*?$", "seeds: 1", text)
    path = os.path.join(folder, "single.yaml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def run(*commands):
    """Wall and processor seconds of commands at once."""
    start, cpu_s = time.monotonic(), 0.0
    for process in [subprocess.Popen(command) for command in commands]:
        _, code, usage = os.wait4(process.pid, 0)
        cpu_s += usage.ru_utime + usage.ru_stime
        if code != 0:
            sys.exit("failed")
    return time.monotonic() - start, cpu_s


def show(name, seconds, more=""):
    print(f"{name:12} {seconds[0]:7.2f} s wall {seconds[1]:7.2f} s processor{more}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=67)
    args = parser.parse_args()
    program, tasks = os.path.abspath(args.program), 16 * args.seeds

    def fresh(name):
        folder = os.path.join(args.folder, name)
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        if name != "anew":
            shutil.copytree(os.path.join(args.folder, "anew", "recordings"), os.path.join(folder, "recordings"))
        return folder

    def sweep(name, jobs):
        return [program, "sweep", DEMO, "-o", fresh(name), "-q", "--jobs", str(jobs), "--set", f"seeds={args.seeds}"]

    os.makedirs(args.folder, exist_ok=True)
    anew = run([program, "sweep", single_study(args.folder), "-o", fresh("anew"), "-q", "--jobs", "1"])
    show("anew", anew)
    one = run(sweep("one", 1))
    show("one job", one, f", {one[1] / tasks * 1000:.1f} ms a trial")
    two = run(sweep("two", 2))
    show("two jobs", two, f", {two[0] / tasks * 1000:.1f} s for 1000")
    both = run(sweep("first", 1), sweep("second", 1))
    show("two at once", both)
    dearer, gain, bound = anew[1] / (one[1] / tasks), one[0] / two[0], 2 * one[0] / both[0]
    print(f"a trial is {dearer:.0f} times cheaper than anew; two jobs are {gain:.2f} times as fast as one, "
          f"two programs {bound:.2f} times")
    missed = dearer < 50 or gain < min(1.8, 0.9 * bound) or two[0] / tasks > 0.24
    sys.exit("a bar was missed" if missed else 0)


if __name__ == "__main__":
    main()
