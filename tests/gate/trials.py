#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""How well the gate tells a worse core from an unchanged one, on configs/gate.yaml.

    cmake --build --preset release --target mapscore mapscore_eroding_more mapscore_losing_voxels
    /usr/bin/python3 -B tests/gate/trials.py build/release FOLDER

1. A core that erodes one pixel more has to fall, in a folder that was swept before and in a fresh one, on the seeds of
   the baseline and on others.
2. The unchanged core has to pass on 20 other lists of seeds.
3. A core that loses one in 23 voxels of one class, about 2 points of its F1, has to be caught in at least 19 of 20
   trials, on the same seeds and on others, with class, cause and worst frame named.

Takes some minutes; exit code 1 where one of these fails.
"""

import csv
import io
import os
import re
import shutil
import subprocess
import sys

GATE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "configs", "gate.yaml")
CLASSES = ["cup", "bottle", "chair", "oven", "tv"]


class Gate:
    def __init__(self, build, work):
        self.build, self.work = os.path.abspath(build), os.path.abspath(work)
        shutil.rmtree(self.work, ignore_errors=True)
        os.makedirs(self.work)
        self.run("mapscore", "record", GATE, "-o", self.path("recording"), "-q")

    def path(self, name):
        return os.path.join(self.work, name)

    def run(self, program, *arguments, lost="", codes=(0,)):
        done = subprocess.run([os.path.join(self.build, program), *arguments], capture_output=True, text=True,
                              check=False, env={**os.environ, "LOST_CLASS": lost})
        assert done.returncode in codes, (arguments, done.returncode, done.stderr)
        return done

    def sweep(self, program, results, *keys, lost=""):
        flags = [word for key in keys for word in ("--set", key)]
        self.run(program, "sweep", GATE, "--set", "recording=" + self.path("recording"), *flags, "-o",
                 self.path(results), "-q", lost=lost)

    def check(self, program, results, baseline, *flags, lost=""):
        return self.run(program, "check", self.path(results), "--baseline", self.path(baseline), *flags, lost=lost,
                        codes=(0, 1, 3))

    def baseline(self, results, name):
        self.run("mapscore", "check", self.path(results), "--baseline", self.path(name), "--update", "--frames")


def erodes_more(gate):
    gate.sweep("mapscore", "used")
    gate.baseline("used", "gate.json")
    for results in ("used", "fresh"):
        gate.sweep("mapscore_eroding_more", results)
        checked = gate.check("mapscore_eroding_more", results, "gate.json")
        print(f"one pixel more, {results} folder: exit code {checked.returncode}; {checked.stdout.splitlines()[-1]}")
        yield checked.returncode == 1 and "erosion" in checked.stdout and "direct " not in checked.stdout


def other_seeds(gate):
    gate.sweep("mapscore", "ten", "seeds=10")
    gate.baseline("ten", "ten.json")
    for program, expected, seeds in (("mapscore_eroding_more", 1, range(2, 7)), ("mapscore", 0, range(2, 22))):
        codes = []
        for seed in seeds:
            gate.sweep(program, "other", "seeds=10", f"seed={seed}")
            codes.append(gate.check(program, "other", "ten.json").returncode)
        print(f"{program} on {len(codes)} other lists of seeds: exit codes {codes}")
        yield all(code == expected for code in codes)


def loses(gate, offset):
    """Of 20 trials: how many are caught and named in full."""
    caught, losses = 0, []
    for seed in range(1, 21):
        number = (seed - 1) % len(CLASSES)
        seeds = "seeds=10" if offset else "seeds=3"
        gate.sweep("mapscore", "right", seeds, f"seed={seed}")
        gate.baseline("right", "right.json")
        gate.sweep("mapscore_losing_voxels", "wrong", seeds, f"seed={seed + offset}", lost=str(number + 1))
        verdict = gate.check("mapscore_losing_voxels", "wrong", "right.json", lost=str(number + 1))
        figures = gate.check("mapscore_losing_voxels", "wrong", "right.json", "--format", "csv", lost=str(number + 1))
        losses += [float(row["change"]) for row in csv.DictReader(io.StringIO(figures.stdout))
                   if row["role"] == "trial" and row["class"] == CLASSES[number] and row["metric"] == "f1"]
        named = re.search(rf"^worse +\S+ +\S+ +{CLASSES[number]} .*(unmapped|unlabelled|mislabelled) \+", verdict.stdout,
                          re.MULTILINE)
        frame = re.search(rf"by themselves \({CLASSES[number]} .*\): frame \d+ found", verdict.stdout)
        caught += verdict.returncode == 1 and bool(named) and bool(frame)
    print(f"loss in one class, {'other' if offset else 'the same'} seeds: F1 falls by {-sum(losses) / len(losses):.4f} "
          f"({-max(losses):.4f} to {-min(losses):.4f}); caught and named {caught} of 20")
    return caught >= 19


def main():
    gate = Gate(*sys.argv[1:3])
    done = [*erodes_more(gate), *other_seeds(gate), loses(gate, 0), loses(gate, 100)]
    return 0 if all(done) else 1


if __name__ == "__main__":
    sys.exit(main())
