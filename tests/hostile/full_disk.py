#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Every verb that writes, on a disk that is full too soon.

    /usr/bin/python3 -B tests/hostile/full_disk.py build/release/mapscore FOLDER            30 sizes a verb
    /usr/bin/python3 -B tests/hostile/full_disk.py build/release/mapscore FOLDER --quick    4 sizes of some

Two kinds of full: a tmpfs that is as large as a share of what the verb writes (mounted in a namespace of our own, as root
or by `unshare -rm`; left out, and said, where neither may), and RLIMIT_FSIZE just below the size of one of its files, which
ends a program by SIGXFSZ that does not look out. A run with room says what is whole. Afterwards

  - the exit code is 2, with one line on standard error, or it is 0 and every file is whole;
  - no file under a final name differs from the whole one (dates in PDF are left out; files with measured times have to be
    well-formed; a store passes SQLite's check, holds trials of the whole one alone, and `table` reads it or refuses it in
    one line);
  - under RLIMIT_FSIZE nothing else is left;
  - the same command, with room, does its work over what was left.

One line a failure; exit code 1 with any. --only VERB runs one verb alone, --mode tmpfs or limit one kind.
"""

import argparse
import concurrent.futures
import os
import resource
import shutil
import subprocess
import sys
import time

import tiny_files as tiny
from program import Failures, Program, shown, snapshot
from together import trials_of
from well_formed import store_fault
from whole import files_of, unsteady_files

PAGE = 4096
QUICK = ("figures", "localize", "record", "sweep", "map", "score --picture", "segment", "truth")
INSIDE = "MAPSCORE_TEST_NAMESPACE"


def listed(texts):
    texts = list(texts)
    return ", ".join(texts[:3]) + (f" and {len(texts) - 3} more" if len(texts) > 3 else "")


def commands(work):
    """{verb: command line}; {out} stands for a folder that is there and empty."""
    def at(name):
        return os.path.join(work, name)
    tiny.write_recording(at("rec"), (b"crate", b"box", b"cup"))
    tiny.write(at("study.yaml"), tiny.STUDY % b"rec")
    os.makedirs(at("scene"))
    tiny.write_scene(at("scene"), classes=(b"crate", b"wedge"), frames_per_s=12)
    quiet = ["-q", "-j", "1"]
    scored = ["score", at("map.ot"), "--truth", at("rec"), *quiet]
    return {
        "record": ["record", at("scene/study.yaml"), "-o", "{out}/rec", *quiet],
        "sweep": ["sweep", at("study.yaml"), "-o", "{out}", "--set", "seeds=4", *quiet],
        "sweep that records": ["sweep", at("scene/study.yaml"), "-o", "{out}", *quiet],
        "tolerance": ["tolerance", at("study.yaml"), "-o", "{out}", "--trials", "24", "--figure", "{out}/figures", *quiet],
        "run": ["run", at("study.yaml"), "-o", "{out}", *quiet],
        "frames": ["frames", at("study.yaml"), "-o", "{out}", "--set", "score.unit=frame", *quiet],
        "trial": ["trial", at("study.yaml"), "-o", "{out}/trial", "--set", "faults.labels.boundary_px=1", *quiet],
        "map": ["map", at("rec"), "-o", "{out}/map.ot", "--color", "{out}/colour.ot", "--ply", "{out}/map.ply", "-q"],
        "score --picture": [*scored, "--picture", "{out}/errors.png", "--errors_ply", "{out}/errors.ply"],
        "resolutions": ["resolutions", at("map.ot"), "--truth", at("rec"), "--picture", "{out}/sizes.png", "--color",
                        "{out}/sizes.ot", *quiet],
        "objects": ["objects", at("rec"), "-o", "{out}", "--min_points", "5", "-q"],
        "segment": ["segment", at("rec"), "-o", "{out}/segments", "--voxel_m", "0.02"],
        "truth": ["truth", at("rec"), "-o", "{out}/truth.csv", "--voxel_m", "0.05", *quiet],
        "truth as PLY": ["truth", at("rec"), "-o", "{out}/truth.ply", "--voxel_m", "0.05", *quiet],
        "localize": ["localize", at("rec"), "-o", "{out}", "-q"],
        "check --update": ["check", at("swept"), "--baseline", "{out}/baseline.json", "--update"],
        "figures": ["figures", at("swept"), "-o", "{out}"],
    }


def prepare(program, work):
    for line in (["sweep", "study.yaml", "-o", "swept", "-q"], ["map", "rec", "-o", "map.ot", "-q"]):
        outcome = program.run(line, work)
        if outcome.code != 0:
            raise SystemExit(f"mapscore {' '.join(line)}: {shown(outcome.err)}")


class Disk:
    """A folder, empty at the start, that holds so many bytes; a plain folder without a size."""

    def __init__(self, place, bytes_=None):
        self.place, self.mounted = place, False
        os.makedirs(place)
        if bytes_:
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={bytes_}", "tmpfs", place], check=True,
                           capture_output=True)
            self.mounted = True

    def grow(self):
        if self.mounted:
            subprocess.run(["mount", "-o", "remount,size=1G", self.place], check=True, capture_output=True)

    def used(self):
        sizes = [len(data) for data in snapshot(self.place).values()]
        return sum((size + PAGE - 1) // PAGE for size in sizes) * PAGE

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.mounted:
            subprocess.run(["umount", self.place], check=True, capture_output=True)
        shutil.rmtree(self.place)


class Verb:
    def __init__(self, program, name, command, work):
        self.program, self.name, self.command, self.work = program, name, command, work
        self.place = os.path.join(work, "disk_" + "".join(c if c.isalnum() else "_" for c in name))
        self.unsteady = set()
        first = self.with_room()
        self.unsteady = unsteady_files(first, self.with_room())
        self.with_room()

    def with_room(self):
        """Runs on a disk with room, and keeps what is whole."""
        with Disk(self.place) as disk:
            outcome = self.run()
            if outcome.code != 0:
                raise SystemExit(f"{self.name}: ended with {outcome.code} on a disk with room: {shown(outcome.err)}")
            self.whole, self.used = files_of(self.place, self.unsteady), disk.used()
            self.sizes = sorted({len(data) for data in snapshot(self.place).values()})
            self.table, self.trials = self.table_of_store(), trials_of(os.path.join(self.place, "results.sqlite"))
            return self.whole

    def run(self, before=None):
        command = [word.replace("{out}", self.place) for word in self.command]
        home = os.path.join(self.work, "home")
        os.makedirs(home, exist_ok=True)
        return self.program.run(command, self.work, home=home, before=before)

    def table_of_store(self):
        if not os.path.exists(os.path.join(self.place, "results.sqlite")):
            return None
        return self.program.run(["table", self.place, "--tidy"], self.work)

    def wrong_files(self):
        """Files under final names that are not the whole ones, and what lies there besides."""
        now = files_of(self.place, self.unsteady)
        cut = [name for name in now if name in self.whole and now[name] != self.whole[name]]
        more = [name for name in now if name not in self.whole]
        return sorted(cut), sorted(more), sorted(set(self.whole) - set(now))

    def store_complaint(self, outcome):
        path = os.path.join(self.place, "results.sqlite")
        if self.table is None or not os.path.exists(path):
            return None
        if os.path.getsize(path) and store_fault(path):
            return f"results.sqlite: {store_fault(path)}"
        trials = trials_of(path)
        if any(self.trials.get(key) != row for key, row in trials.items()):
            return "results.sqlite: holds other trials"
        if outcome.code == 0 and len(trials) < len(self.trials):
            return f"results.sqlite: {len(trials)} of {len(self.trials)} trials after exit code 0"
        table = self.table_of_store()
        if table.code == 0:
            return None if table.out == self.table.out else "results.sqlite: table prints other scores"
        if outcome.code == 0 and self.table.code == 0:  # that of a tolerance alone has none
            return "results.sqlite: table refuses it after exit code 0"
        return table.complaint()

    def judge(self, outcome, limit):
        """Lines of what is wrong after a run without room."""
        wrong = []
        if outcome.complaint():
            wrong.append(outcome.complaint())
        cut, more, missing = self.wrong_files()
        said = f"exit code {outcome.code}" if outcome.code >= 0 else "ended by a signal"
        if cut:
            sizes = [os.path.getsize(os.path.join(os.fsencode(self.place), name)) for name in cut]
            wrong.append(f"{said}, cut under its final name: {listed(f'{shown(n)} ({s} bytes)' for n, s in zip(cut, sizes))}")
        if outcome.code == 0 and missing:
            wrong.append(f"exit code 0, missing: {listed(map(shown, missing))}")
        if limit and more:
            wrong.append(f"{said}, left over: {listed(map(shown, more))}")
        if self.store_complaint(outcome):
            wrong.append(self.store_complaint(outcome))
        return wrong

    def try_size(self, size, limit):
        """limit: as RLIMIT_FSIZE, not as a tmpfs."""
        with Disk(self.place, None if limit else size) as disk:
            before = (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))) if limit else None
            outcome = self.run(before)
            wrong = self.judge(outcome, limit)
            if outcome.code == 0:
                return outcome, wrong
            disk.grow()
            again = self.run()
            if again.code != 0:
                wrong.append(f"with room again: exit code {again.code}: {shown(again.err)}")
            elif self.wrong_files()[0] or self.wrong_files()[2]:
                cut, _, missing = self.wrong_files()
                wrong.append(f"with room again, cut or missing: {listed(map(shown, cut + missing))}")
            return outcome, wrong


def spread(values, count):
    """At most so many of them, evenly spaced."""
    values = sorted(set(values))
    if len(values) <= count:
        return values
    if count == 1:
        return [values[len(values) // 2]]
    return sorted({values[round(n * (len(values) - 1) / (count - 1))] for n in range(count)})


def sizes_of(verb, limit, count):
    if limit:
        near = [size - 1 for size in verb.sizes if size > 1]
        most = max(verb.sizes)
        between = [most * n // count for n in range(1, count)]
        return spread(near, count - count // 3) + spread([size for size in between if size not in near], count // 3)
    pages = verb.used // PAGE
    return [n * PAGE for n in spread(range(1, pages + pages // 3 + 2), count)]


def can_mount(work):
    try:
        with Disk(os.path.join(work, "probe"), PAGE):
            return True
    except (subprocess.CalledProcessError, OSError):
        shutil.rmtree(os.path.join(work, "probe"), ignore_errors=True)
        return False


def enter_namespace():
    """Starts this script again where its mounts are seen by nobody else and vanish with it."""
    if os.environ.get(INSIDE):
        return
    os.environ[INSIDE] = "1"
    options = "-m" if os.geteuid() == 0 else "-rm"
    if shutil.which("unshare") and subprocess.run(["unshare", options, "true"], check=False, capture_output=True).returncode == 0:
        os.execvp("unshare", ["unshare", options, sys.executable, "-B", *sys.argv])


def fill(verb, modes, count):
    """All sizes of one verb, on both kinds of full disk."""
    for mode in modes:
        codes = {}
        sizes = sizes_of(verb, mode == "limit", count)
        for size in sizes:
            outcome, wrong = verb.try_size(size, mode == "limit")
            codes[outcome.code] = codes.get(outcome.code, 0) + 1
            for what in wrong:
                verb.program.failures.add(f"{verb.name}, {mode} of {size} bytes: {what}")
        print(f"{verb.name}, {mode}: {len(sizes)} sizes up to {max(sizes)} bytes, {len(verb.whole)} files of {verb.used} "
              f"bytes; exit codes {dict(sorted(codes.items()))}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    parser.add_argument("--mode", choices=["tmpfs", "limit"])
    flags = parser.parse_args()
    enter_namespace()
    work = os.path.abspath(os.path.join(flags.folder, "full_disk"))
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    failures, start = Failures(), time.monotonic()
    program = Program(flags.program, flags.folder, failures)
    lines = {name: line for name, line in commands(work).items() if not flags.only or name == flags.only}
    prepare(program, work)
    modes = [mode for mode in ("tmpfs", "limit") if flags.mode in (None, mode)]
    if "tmpfs" in modes and not can_mount(work):
        print("tmpfs: left out, nothing may be mounted here")
        modes.remove("tmpfs")
    if flags.quick and not flags.only:
        lines = {name: lines[name] for name in QUICK}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda item: fill(Verb(program, *item, work), modes, 4 if flags.quick else 30), lines.items()))
    print(f"{failures.runs} runs in {time.monotonic() - start:.0f} s: {len(failures.lines)} failures")
    return 1 if failures.lines else 0


if __name__ == "__main__":
    sys.exit(main())
