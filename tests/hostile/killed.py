#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A sweep that is killed (SIGKILL, by its process id) at a random moment, and resumed.

    /usr/bin/python3 -B tests/hostile/killed.py build/release/mapscore FOLDER            100 kills a way
    /usr/bin/python3 -B tests/hostile/killed.py build/release/mapscore FOLDER --quick    5 kills a way

Ways: `alone`; `full disk`, on a tmpfs too small for the store, which gets room before the sweep goes on; `read-only`,
where the results folder loses its write permission on the way (and root its privilege to pass over that); `two sweeps` of
one study into one folder, of which one or both are killed. A sweep that ends by itself first, of a full disk or a folder
that cannot be written, does so with exit code 2 and one line, or was done; it counts as no kill.

After a kill, every trial in the store is the one that a sweep computes alone, and `status`, `trials` and `table --interim`
read the folder or refuse it in one line. The sweep that goes on computes what is missing and nothing else; then the store
holds every trial once, those from before are the same, no other file is left, and `table --tidy` has the bytes of a sweep
that nobody disturbed. One line a failure; exit code 1 with any. --only WAY tries one alone, --seed N other moments.
"""

import argparse
import contextlib
import os
import random
import re
import shutil
import stat
import sys
import time

import tiny_files as tiny
from full_disk import Disk, can_mount, enter_namespace
from program import Failures, Program, shown
from together import trials_of

FILES = {"results.sqlite", "status.json"}
POWERLESS = ("--bounding-set=-dac_override,-dac_read_search",)  # a file's mode holds for root too


class Wrong(Exception):
    """What a round found."""


class Sweep:
    """A small study, what a sweep of it leaves when nobody disturbs it, and how long that takes."""

    def __init__(self, program, work, chance, seeds):
        self.program, self.work, self.chance = program, work, chance
        self.place = os.path.join(work, "place")
        tiny.write_recording(os.path.join(work, "rec"), (b"crate", b"box", b"cup"))
        tiny.write(os.path.join(work, "study.yaml"), tiny.STUDY % b"rec")
        self.command = ["sweep", "study.yaml", "-o", self.place, "--set", f"seeds={seeds}"]
        with Disk(self.place) as disk:
            start = time.monotonic()
            outcome = self.go_on()
            self.seconds = time.monotonic() - start
            if outcome.code != 0:
                raise SystemExit(f"the sweep ended with {outcome.code} alone: {shown(outcome.err)}")
            self.trials, self.csv, self.bytes = self.stored(), self.table(), disk.used()

    def start(self, command=(), jobs=None, flags=("-q",)):
        jobs = jobs or self.chance.choice((1, 2))
        return self.program.start([*self.command, "-j", str(jobs), *flags], self.work, command=command)

    def go_on(self):
        return self.program.wait(self.start(flags=()))

    def some_time(self, share=1.0):
        time.sleep(self.chance.uniform(0.0, share * self.seconds))

    def table(self):
        outcome = self.program.run(["table", self.place, "--tidy"], self.work)
        if outcome.code != 0:
            raise Wrong(f"table: {shown(outcome.err)}")
        return outcome.out

    def stored(self):
        """{key: (description, result)}"""
        trials = trials_of(os.path.join(self.place, "results.sqlite"))
        if trials is None:
            raise Wrong("the store is damaged")
        return trials

    def judge_rest(self, command=()):
        """What is there after a kill: trials as they are when computed alone. Returns their keys."""
        trials = self.stored()
        wrong = [key for key, row in trials.items() if self.trials.get(key) != row]
        if wrong:
            raise Wrong(f"{len(wrong)} of {len(trials)} trials differ from those computed alone")
        for verb in (["status"], ["trials"], ["table", "--interim"]):
            outcome = self.program.run([verb[0], self.place, *verb[1:]], self.work, command=command)
            refused = outcome.code and trials and not command and len(verb) == 1
            if outcome.complaint() or refused:
                raise Wrong(f"{' '.join(verb)} after a kill: {outcome.complaint() or shown(outcome.err)}")
        return trials.keys()

    def judge_whole(self):
        if self.stored() != self.trials:
            raise Wrong("the store does not hold every trial once, as computed alone")
        if self.table() != self.csv:
            raise Wrong("table --tidy prints other bytes")
        if more := set(os.listdir(self.place)) - FILES:
            raise Wrong(f"left over: {', '.join(sorted(more))}")

    def finish(self, there):
        """Goes on, and judges that it computed what was missing alone."""
        outcome = self.go_on()
        if outcome.code != 0:
            raise Wrong(f"the sweep after it ended with {outcome.code}: {shown(outcome.err)}")
        told = re.search(rb"(\d+) trials computed, (\d+) already there", outcome.err)
        if not told or (int(told[1]), int(told[2])) != (len(self.trials) - len(there), len(there)):
            raise Wrong(f"of {len(self.trials)} trials {len(there)} were there, but: {shown(outcome.err)}")
        self.judge_whole()


def kill(sweep, process):
    """True where it still ran. One that did not has done its work, or says why not."""
    running = process.poll() is None
    process.kill()
    outcome = sweep.program.wait(process)
    if not running and (outcome.complaint() or outcome.code == 1):
        raise Wrong(outcome.complaint() or f"exit code 1: {shown(outcome.err)}")
    return running


def alone(sweep):
    with Disk(sweep.place):
        process = sweep.start()
        sweep.some_time()
        killed = kill(sweep, process)
        there = sweep.judge_rest()
        sweep.finish(there)
    return killed, len(there)


def on_a_full_disk(sweep):
    share = sweep.chance.uniform(0.1, 0.95)
    with Disk(sweep.place, int(sweep.bytes * share)) as disk:
        process = sweep.start()
        sweep.some_time(0.5 * share)  # before it is full
        killed = kill(sweep, process)
        there = sweep.judge_rest()
        disk.grow()
        sweep.finish(there)
    return killed, len(there)


@contextlib.contextmanager
def read_only(folder):
    paths = [folder, *(os.path.join(folder, name) for name in os.listdir(folder))]
    modes = {}
    for path in paths:
        with contextlib.suppress(FileNotFoundError):  # a journal comes and goes
            modes[path] = stat.S_IMODE(os.stat(path).st_mode)
            os.chmod(path, modes[path] & 0o555)
    try:
        yield
    finally:
        for path, mode in modes.items():
            with contextlib.suppress(FileNotFoundError):
                os.chmod(path, mode)


def in_a_read_only_folder(sweep):
    powerless = (shutil.which("setpriv"), *POWERLESS) if os.geteuid() == 0 else ()
    with Disk(sweep.place):
        process = sweep.start(powerless)
        sweep.some_time()
        with read_only(sweep.place):
            if sweep.chance.random() < 0.5:
                process.wait(120)  # ends by itself, and says why
            time.sleep(sweep.chance.uniform(0.0, 0.02))
            killed = kill(sweep, process)
            there = sweep.judge_rest(powerless)
        sweep.finish(there)
    return killed, len(there)


def of_two_sweeps(sweep):
    with Disk(sweep.place):
        both = [sweep.start(jobs=1), sweep.start(jobs=1)]
        sweep.some_time()
        victims = sweep.chance.choice(([both[0]], [both[1]], both))
        killed = sum([kill(sweep, victim) for victim in victims]) > 0
        for process in both:
            if process not in victims and (outcome := sweep.program.wait(process)).code != 0:
                raise Wrong(f"the other sweep ended with {outcome.code}: {shown(outcome.err)}")
        there = sweep.judge_rest()
        sweep.finish(there)
    return killed, len(there)


WAYS = {"alone": alone, "full disk": on_a_full_disk, "read-only": in_a_read_only_folder, "two sweeps": of_two_sweeps}


def try_way(sweep, way, kills):
    hit, rounds, there = 0, 0, []
    while hit < kills and rounds < 4 * kills:
        rounds += 1
        try:
            killed, trials = WAYS[way](sweep)
            hit += killed
            there += [trials] if killed else []
        except Wrong as wrong:
            sweep.program.failures.add(f"{way}, round {rounds}: {wrong}")
            hit += 1
    there.sort()
    print(f"{way}: {rounds} rounds, {hit} sweeps killed while they ran, with "
          f"{f'{there[0]} to {there[-1]}, median {there[len(there) // 2]}' if there else 'none'} of {len(sweep.trials)} "
          "trials there", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", choices=WAYS)
    parser.add_argument("--seed", type=int, default=1)
    flags = parser.parse_args()
    enter_namespace()
    work = os.path.abspath(os.path.join(flags.folder, "killed"))
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    failures, start = Failures(), time.monotonic()
    program = Program(flags.program, flags.folder, failures)
    sweep = Sweep(program, work, random.Random(flags.seed), 10 if flags.quick else 20)
    for way in [flags.only] if flags.only else WAYS:
        if way == "full disk" and not can_mount(work):
            print("full disk: left out, nothing may be mounted here")
        elif way == "read-only" and os.geteuid() == 0 and not shutil.which("setpriv"):
            print("read-only: left out, without setpriv root writes everywhere")
        else:
            try_way(sweep, way, 5 if flags.quick else 100)
    print(f"{failures.runs} runs in {time.monotonic() - start:.0f} s: {len(failures.lines)} failures")
    return 1 if failures.lines else 0


if __name__ == "__main__":
    sys.exit(main())
