#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Two runs of one verb into one place, the second starting at twenty offsets within the first.

    /usr/bin/python3 -B tests/hostile/together.py build/release/mapscore FOLDER            20 offsets
    /usr/bin/python3 -B tests/hostile/together.py build/release/mapscore FOLDER --quick    3 offsets of some verbs

The two are given different inputs, so that a mixture shows. Afterwards the place has to hold, byte for byte, what the one
or the other writes alone (both, where no file is of both), and whoever did not win has said so in one line and ended
with exit code 2. At least one wins. Then the first run is started once more, alone, and has to find nothing in its way: a
leftover of the two may not block it. Of a store, whose pages may lie in any order, `table --tidy` is compared, and every
trial against the one that was computed alone. Dates in PDF are left out; files with
measured times have to be well-formed. One line a failure; exit code 1 with any.
--only VERB runs one verb alone.
"""

import argparse
import contextlib
import os
import shutil
import sqlite3
import sys
import tempfile
import time

import tiny_files as tiny
from program import Failures, Program, shown
from whole import files_of, unsteady_files


QUICK = ("record", "sweep", "sweep that records", "map", "figures", "score", "resolutions")


class Pair:
    """A verb, its two command lines, and the place that both write into. {out} stands for the place."""

    def __init__(self, verb, first, second, store=False, once=False):
        self.verb, self.commands, self.store = verb, (first, second), store
        self.unsteady = set()  # files with measured times
        self.once = once  # the place must not exist, so that a second run is refused for good


def commands(work):
    """Inputs below `work`, and the pairs over them."""
    def at(name):
        return os.path.join(work, name)
    tiny.write_recording(at("near"))
    tiny.write_recording(at("far"), shift_m=-0.3)
    for name in ("near", "far"):
        tiny.write(at(f"{name}.yaml"), tiny.STUDY % name.encode())
        os.makedirs(at(f"scene_{name}"))
    tiny.write_scene(at("scene_near"), classes=(b"crate", b"wedge"), frames_per_s=12)
    tiny.write_scene(at("scene_far"), classes=(b"other", b"wedge"), frames_per_s=13)
    near, far = at("near"), at("far")
    quiet = ["-q", "-j", "1"]
    def both(verb, first, second, *flags, **options):
        return Pair(verb, [verb, first, *flags], [verb, second, *flags], **options)
    many = ["--set", "seeds=20"]
    return [
        both("record", at("scene_near/study.yaml"), at("scene_far/study.yaml"), "-o", "{out}/rec", *quiet, once=True),
        both("sweep", at("near.yaml"), at("far.yaml"), "-o", "{out}", *many, *quiet, store=True),
        Pair("sweep, one study", *[["sweep", at("near.yaml"), "-o", "{out}", *many, *quiet]] * 2, store=True),
        Pair("sweep that records", *[["sweep", at(f"scene_{name}/study.yaml"), "-o", "{out}", *quiet] for name in ("near", "near")],
             store=True),
        both("map", near, far, "-o", "{out}/map.ot", "--color", "{out}/colour.ot", "--ply", "{out}/map.ply",
             "--voxel_m", "0.02", "-q"),
        both("figures", at("swept_near"), at("swept_far"), "-o", "{out}"),
        both("run", at("near.yaml"), at("far.yaml"), "-o", "{out}", *quiet),
        Pair("run, one study", *[["run", at("near.yaml"), "-o", "{out}", *quiet]] * 2),
        both("frames", at("near.yaml"), at("far.yaml"), "-o", "{out}", "--format", "csv", "--set", "score.unit=frame", *quiet),
        both("objects", near, far, "-o", "{out}", "--min_points", "5", "-q"),
        both("localize", near, far, "-o", "{out}", "-q"),
        both("segment", near, far, "-o", "{out}/segments", once=True),
        both("truth", near, far, "-o", "{out}/truth.csv", "--voxel_m", "0.02", *quiet),
        Pair("score", *[["score", at(f"{name}.ot"), "--truth", at(name), "--details", "--picture",
                         "{out}/errors.png", "--errors_ply", "{out}/errors.ply", *quiet] for name in ("near", "far")]),
        Pair("resolutions", *[["resolutions", at(f"{name}.ot"), "--truth", at(name), "--picture",
                               "{out}/sizes.png", "--color", "{out}/sizes.ot", *quiet] for name in ("near", "far")]),
    ]


def prepare(program, work):
    """What some verbs read: a store and a map of each recording."""
    for name in ("near", "far"):
        for line in (["sweep", f"{name}.yaml", "-o", f"swept_{name}", "-q"], ["map", name, "-o", f"{name}.ot", "-q"]):
            outcome = program.run(line, work)
            if outcome.code != 0:
                raise SystemExit(f"mapscore {' '.join(line)}: {shown(outcome.err)}")


def filled(command, place):
    return [word.replace("{out}", place) for word in command]


def trials_of(store):
    """{key: (description, result)} of a copy, in which SQLite rolls back what was not finished; None when damaged."""
    with tempfile.TemporaryDirectory() as folder:
        for ending in ("", "-journal", "-wal"):
            if os.path.exists(store + ending):
                shutil.copyfile(store + ending, os.path.join(folder, "copy.sqlite" + ending))
        with contextlib.closing(sqlite3.connect(os.path.join(folder, "copy.sqlite"))) as file:
            if file.execute("pragma integrity_check").fetchone() != ("ok",):
                return None
            if not file.execute("select * from sqlite_master where name = 'trials'").fetchall():
                return {}
            return {row[0]: row[1:] for row in file.execute("select key, description, result from trials")}


class Alone:
    """What a command leaves when nobody disturbs it, and how long it takes."""

    def __init__(self, program, pair, command, place):
        first = self.measured(program, pair, command, place)
        pair.unsteady |= unsteady_files(first, self.measured(program, pair, command, place))
        self.result = self.measured(program, pair, command, place)

    def measured(self, program, pair, command, place):
        os.makedirs(place)
        start = time.monotonic()
        outcome = program.run(filled(command, place), os.path.dirname(place))
        self.seconds = time.monotonic() - start
        if outcome.code != 0:
            raise SystemExit(f"{' '.join(command)}: ended with {outcome.code} alone: {shown(outcome.err)}")
        result = result_of(program, pair, place)
        self.trials = trials_of(os.path.join(place, "results.sqlite")) if pair.store else {}
        shutil.rmtree(place)
        return result


def result_of(program, pair, place):
    """Files, and of a store what it says, as one dictionary."""
    result = files_of(place, pair.unsteady)
    if pair.store:
        tidy = program.run(["table", place, "--tidy"], place)
        result[b"table --tidy"] = tidy.out if tidy.code == 0 else b"refused: " + tidy.err
    return result


def differences(result, whole):
    names = sorted(name for name in set(result) | set(whole) if result.get(name) != whole.get(name))
    return ", ".join(f"{shown(name)} {'missing' if name not in result else 'left over' if name not in whole else 'differs'}"
                     for name in names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")


def judge(program, pair, place, outcomes, alone):
    """One line of what is wrong, or None."""
    winners = [n for n, outcome in enumerate(outcomes) if outcome.code == 0]
    for outcome in outcomes:
        complaint = outcome.complaint() or ("exit code 1" if outcome.code == 1 else None)
        if complaint:
            return complaint
    if not winners:
        return f"both were refused: {shown(outcomes[0].err)} / {shown(outcomes[1].err)}"
    result = result_of(program, pair, place)
    wholes = [alone[n].result for n in winners]
    if len(winners) == 2 and not set(wholes[0]) & set(wholes[1]):
        wholes = [{**wholes[0], **wholes[1]}]
    if result not in wholes:
        ended = " and ".join(f"{'first' if n == 0 else 'second'} ended with {o.code}" for n, o in enumerate(outcomes))
        return f"a mixture: {ended}; against the nearest: {min((differences(result, whole) for whole in wholes), key=len)}"
    return judge_store(place, outcomes, alone) if pair.store else None


def judge_store(place, outcomes, alone):
    trials = trials_of(os.path.join(place, "results.sqlite"))
    if trials is None:
        return "the store is damaged"
    known = {}
    for n, outcome in enumerate(outcomes):
        known.update(alone[n].trials)
        if outcome.code == 0 and not alone[n].trials.keys() <= trials.keys():
            return f"{len(alone[n].trials.keys() - trials.keys())} trials are missing of a sweep that ended with 0"
    wrong = [key for key, row in trials.items() if known.get(key) != row]
    return f"{len(wrong)} trials differ from those computed alone" if wrong else None


def race(program, pair, place, offset_s, alone):
    os.makedirs(place)
    folder = os.path.dirname(place)
    first = program.start(filled(pair.commands[0], place), folder)
    time.sleep(offset_s)
    second = program.start(filled(pair.commands[1], place), folder)
    outcomes = [program.wait(process) for process in (first, second)]
    wrong = judge(program, pair, place, outcomes, alone)
    if wrong:
        return wrong, outcomes
    if pair.once:  # the winner's folder is in the way by design, its leftovers are not
        inner = [word for word in filled(pair.commands[0], place) if word.startswith(place + "/")][0]
        shutil.rmtree(inner)
    again = program.run(filled(pair.commands[0], place), folder)
    if again.code != 0:
        return f"a run after both ended with {again.code}: {shown(again.err)}", outcomes
    result = result_of(program, pair, place)
    whole = alone[0].result
    if any(result.get(name) != data for name, data in whole.items()):
        return f"a run after both is not whole: {differences(result, whole)}", outcomes
    return None, outcomes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    flags = parser.parse_args()
    work = os.path.abspath(os.path.join(flags.folder, "together"))
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    failures, start = Failures(), time.monotonic()
    program = Program(flags.program, flags.folder, failures)
    offsets = 3 if flags.quick else 20
    pairs = commands(work)
    if flags.only or flags.quick:
        wanted = [flags.only] if flags.only else QUICK
        pairs = [pair for pair in pairs if pair.verb in wanted]
    prepare(program, work)
    for pair in pairs:
        alone = [Alone(program, pair, command, os.path.join(work, "place")) for command in pair.commands]
        refused = 0
        for n in range(offsets):
            offset_s = alone[0].seconds * n / (offsets - 1)
            place = os.path.join(work, "place")
            wrong, outcomes = race(program, pair, place, offset_s, alone)
            refused += any(outcome.code == 2 for outcome in outcomes)
            if wrong:
                failures.add(f"{pair.verb}, {1000 * offset_s:.0f} ms apart: {wrong}")
            shutil.rmtree(place)
        print(f"{pair.verb}: {offsets} offsets up to {alone[0].seconds:.2f} s, one of the two refused in {refused}", flush=True)
    print(f"{failures.runs} runs in {time.monotonic() - start:.0f} s: {len(failures.lines)} failures")
    return 1 if failures.lines else 0


if __name__ == "__main__":
    sys.exit(main())
