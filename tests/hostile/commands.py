#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A sweep whose methods are commands that go wrong in every way we know.

    /usr/bin/python3 -B tests/hostile/commands.py build/release/mapscore FOLDER            also one at a time, more jobs
    /usr/bin/python3 -B tests/hostile/commands.py build/release/mapscore FOLDER --quick    all in one sweep

Each way costs its own trial alone: the sweep ends with 1 and in time, the trial is stored as failed with a reason that
says what went wrong, and every other row of the store is, byte for byte, that of a sweep without it. Afterwards no process
that the sweep started is left, and nothing below TMPDIR. Failed trials are tried again by --retry_failed alone. A sweep
that is killed (SIGKILL) or stopped (SIGINT) leaves no process, and the next one removes its scratch folder. As root the
scratch folder is once on a tmpfs that a command fills. One line a failure; exit code 1 with any.
"""

import argparse
import os
import shutil
import signal
import sqlite3
import struct
import subprocess
import sys
import time

import tiny_files as tiny

MARK = f"MAPSCORE_HOSTILE_COMMANDS={os.getpid()}"
GOOD = 'cp "$0" "$2"'  # $0: a ready map, $1: the trial, $2: the map to write
# Of a SemanticOcTree's plain sibling: one leaf that is the whole octree, 65536 voxels a side.
ONE_LEAF = b"# Octomap OcTree file\nid OcTree\nsize 1\nres 0.05\ndata\n" + struct.pack("<fB", 1.0, 0)

# name: (what the shell runs, what the reason says; None: its map is good)
WAYS = {
    "exits": ("echo first; echo the last line >&2; exit 1", "exit code 1; its log ends: 'first\\nthe last line'"),
    "segfaults": ("kill -SEGV $$", "signal 11"),
    "kills_itself": ("kill -KILL $$", "signal 9"),
    "sleeps": ("sleep 1000", "took longer than"),
    "stops": ("kill -STOP $$", "took longer than"),
    "ignores_signals": ("trap '' TERM INT HUP QUIT; while :; do sleep 1; done", "took longer than"),
    "floods": ("yes", "took longer than"),
    "logs_much": ("head -c 50000000 /dev/zero; echo the end; exit 4", "the end"),
    "another_frame": ('sed "s/^/9/" "$0" | sed "s/^9i/i/" > "$2"', "another frame"),
    "not_a_number": ('printf "x,y,z,class\\nnan,0,0,1\\n" > "$2"', "nan"),
    "empty_file": (': > "$2"', "empty"),
    "too_many_bytes": ('head -c 300000000 /dev/zero > "$2"', "bytes, more than"),
    "file_without_end": ('cat /dev/zero > "$2"', "exit code 153"),  # of the shell, whose cat got signal 25
    "writes_input": ('chmod u+w "$1"/color/*; echo more >> "$1/color/000001.png"; ' + GOOD, "changed its input color/000001.png"),
    "removes_input": ("rm -rf ../images; " + GOOD, "changed its input"),
    "leaves_children": ("sleep 1000 & setsid sleep 1000 & " + GOOD, None),
    "leaves_daemon": ("(setsid sh -c 'trap \"\" TERM HUP; (sleep 1000 &); sleep 1000' >/dev/null 2>&1 &); " + GOOD, None),
    "leaves_many": ("for n in $(seq 100); do sleep 1000 & done; exit 1", "exit code 1"),
    "reads_input": ('cat > "$2"', "empty"),
    "no_map": ("echo nothing to do", "wrote no voxels.csv; its log ends: 'nothing to do'"),
    "silent": ("true", "printed nothing"),
    "half_a_map": ('head -c 1000 "$0" > "$2"; printf "1,2" >> "$2"', "cells"),
    "map_is_folder": ('mkdir "$2"', "is no file"),
    "map_is_pipe": ('mkfifo "$2"', "is no file"),
    "map_is_link": ('ln -s /dev/zero "$2"', "is no file"),
    "rubbish": ('head -c 100000 /dev/urandom > "$2"', "voxels.csv:"),
    "unknown_classes": ('printf "i,j,k,class\\n0,0,0,unicorn\\n" > "$2"', "unicorn"),
    "without_classes": ('printf "i,j,k\\n0,0,0\\n" > "$2"', "no classes"),
    "twice_the_same": ('printf "i,j,k,class\\n0,0,0,1\\n0,0,0,1\\n" > "$2"', "already"),
    "stays_unheard": ("exec >&- 2>&-; sleep 1000", "took longer than"),
    "leaves_locked_folders": ("mkdir -p a/b; touch a/b/c; chmod -R 0 a; exit 1", "exit code 1"),
    "controls_terminal": ("printf '\\033[2J\\033]0;owned\\007'; exit 1", "\\x1b[2J"),
}


class Trial:
    def __init__(self, program, work):
        self.program, self.work, self.failed = program, work, 0
        self.tmp = os.path.join(work, "tmp")
        os.makedirs(self.tmp)

    def at(self, name):
        return os.path.join(self.work, name)

    def fail(self, line):
        self.failed += 1
        print("FAIL", line, flush=True)

    def environment(self):
        name, value = MARK.split("=")
        return {**os.environ, name: value, "TMPDIR": self.tmp}

    def start(self, *arguments):
        return subprocess.Popen([self.program, *arguments], env=self.environment(), stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def run(self, *arguments, code=0):
        process = self.start(*arguments)
        out, err = process.communicate(timeout=600)
        if process.returncode != code:
            self.fail(f"{' '.join(arguments[:3])}: exit code {process.returncode}, not {code}: {err[-500:]!r}")
        self.nothing_left(arguments[0])
        return out.decode()

    def study(self, name, ways, seeds=1):
        lines = ["recording: rec", "map_origin_m: [0, 0, 0]", f"seeds: {seeds}", "methods:",
                 "  direct: {segmentation: {direct: {}}}"]
        for way, (script, _) in {"good": (GOOD, None), **ways}.items():
            words = ", ".join(tiny.in_yaml(word.encode()).decode() for word in ("sh", "-c", script, self.at("ready.csv"),
                                                                                "{trial}", "{map}"))
            lines.append(f"  {way}: {{command: [{words}], map: voxels.csv, timeout_s: 3}}")
        tiny.write(self.at(name), "\n".join(lines) + "\n")
        return self.at(name)

    def processes(self):
        found = []
        for entry in os.listdir("/proc"):
            try:
                with open(f"/proc/{entry}/environ", "rb") as file:
                    if MARK.encode() in file.read().split(b"\0"):
                        with open(f"/proc/{entry}/cmdline", "rb") as line:
                            found.append((entry, line.read()))
            except OSError:
                continue
        return found

    def nothing_left(self, what):
        for process in self.processes():
            self.fail(f"{what}: left process {process}")
        for name in os.listdir(self.tmp):
            self.fail(f"{what}: left {name} below TMPDIR")

    def rows(self, results):
        with sqlite3.connect(f"{results}/results.sqlite") as store:
            store.text_factory = lambda text: text.decode("utf-8", "backslashreplace")
            trials = {key: row for key, *row in store.execute("SELECT * FROM trials")}
            reasons = {name[7:]: value for name, value in store.execute("SELECT * FROM texts WHERE name LIKE 'failed %'")}
        return trials, reasons

    def methods(self, results):
        lines = [line.split(",", 3) for line in self.run("trials", results, "--format", "csv").splitlines()
                 if line and not line.startswith("#")]
        return {key: method for key, role, method, _ in lines[1:] if role == "trial"}


def prepare(trial):
    tiny.write_recording(trial.at("rec"))
    tiny.write(trial.at("direct.yaml"), "recording: rec\nmap_origin_m: [0, 0, 0]\nmethods: {direct: {segmentation: {direct: {}}}}\n")
    trial.run("map", trial.at("rec"), "-o", trial.at("ready.ot"), "--ply", trial.at("ready.ply"), "--segmentation", "direct", "-q")
    # Centres of voxels of 5 cm with their classes.
    with open(trial.at("ready.ply"), "rb") as file:
        header, body = file.read().split(b"end_header\n", 1)
    kinds = [line.split()[1:] for line in header.decode().splitlines() if line.startswith("property")]
    codes = {"float": "f", "double": "d", "uchar": "B", "ushort": "H", "int": "i", "uint": "I", "short": "h"}
    form = "<" + "".join(codes[kind] for kind, _ in kinds)
    names = [name for _, name in kinds]
    rows = ["i,j,k,class"]
    for values in struct.iter_unpack(form, body):
        at = dict(zip(names, values))
        key = [int(at[axis] // 0.05) for axis in "xyz"]
        rows.append(",".join(map(str, key + [at.get("label", at.get("class"))])))
    tiny.write(trial.at("ready.csv"), "\n".join(rows) + "\n")


def judge(trial, what, results, ways, undisturbed, seconds, most_seconds):
    trials, reasons = trial.rows(results)
    methods = trial.methods(results)
    for key, row in undisturbed.items():
        if trials.get(key) != row:
            trial.fail(f"{what}: the row of {methods.get(key, 'a ceiling')} is not that of the undisturbed sweep")
    for key, method in methods.items():
        if method not in ways:
            continue
        wanted = ways[method][1]
        if wanted is None and key not in trials:
            trial.fail(f"{what}: {method} failed: {reasons.get(key)}")
        if wanted is not None and (key in trials or wanted not in reasons.get(key, "")):
            trial.fail(f"{what}: {method}: {'has a result' if key in trials else reasons.get(key)!r}, expected {wanted!r}")
    if seconds > most_seconds:
        trial.fail(f"{what}: took {seconds:.0f} s")


def sweep_all(trial, name, ways, undisturbed, jobs, code=1):
    results = trial.at(f"{name}_results")
    start = time.monotonic()
    study = trial.study(f"{name}.yaml", ways)
    trial.run("sweep", study, "-o", results, "-q", "-j", str(jobs), code=code)
    judge(trial, name, results, ways, undisturbed, time.monotonic() - start, 30 + 12 * len(ways))
    return study, results


def try_again(trial, study, results):
    before = trial.rows(results)
    start = time.monotonic()
    trial.run("sweep", study, "-o", results, "-q", "-j", "2", code=1)
    if time.monotonic() - start > 5:
        trial.fail("the next sweep tried failed commands again")
    table = trial.run("table", results)
    for part in ("FAILED: 1 failed of ", "good"):
        if part not in table:
            trial.fail(f"table says nothing of {part!r}")
    trial.run("sweep", study, "-o", results, "-q", "-j", "2", "--retry_failed", code=1)
    if trial.rows(results)[0] != before[0] or trial.rows(results)[1].keys() != before[1].keys():
        trial.fail("--retry_failed changed what is there")


def break_off(trial, how):
    """A sweep that is ended while its command sleeps."""
    study = trial.study(f"broken_{how}.yaml", {"sleeps": ("setsid sleep 1000 & sleep 1000", "")})
    results = trial.at(f"broken_{how}")
    with open(study, "r+") as file:
        text = file.read().replace("timeout_s: 3", "timeout_s: 500")
        file.seek(0)
        file.write(text)
    process = trial.start("sweep", study, "-o", results, "-q", "-j", "1")
    for _ in range(500):
        if any(line.startswith(b"sleep") for _, line in trial.processes()):
            break
        time.sleep(0.02)
    else:
        trial.fail(f"{how}: the command never began")
    process.send_signal(how)
    process.communicate(timeout=60)
    for _ in range(250):
        if not trial.processes():
            break
        time.sleep(0.02)
    if how == signal.SIGKILL:
        trial.run("sweep", trial.study("after.yaml", {}), "-o", trial.at("after"), "-q", "-j", "1")
    elif process.returncode != 130:
        trial.fail(f"SIGINT: exit code {process.returncode}")
    trial.nothing_left(f"{how!r}")
    if trial.rows(results)[1]:
        trial.fail(f"{how!r}: what was ended from outside counts as failed")


def full_disk(trial, undisturbed):
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=12m", "none", trial.tmp], capture_output=True).returncode != 0:
        print("full disk: left out, no tmpfs may be mounted")
        return
    try:
        ways = {"fills_the_disk": ("cat /dev/zero > here; cat here > there; exit 1", "exit code 1"),
                "fills_by_its_map": ('head -c 100000000 /dev/zero > "$2"', "exit code 1"), "afterwards": (GOOD, None)}
        sweep_all(trial, "full_disk", ways, undisturbed, 1)
    finally:
        subprocess.run(["umount", trial.tmp], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    flags = parser.parse_args()
    shutil.rmtree(flags.folder, ignore_errors=True)
    os.makedirs(flags.folder)
    trial = Trial(os.path.abspath(flags.program), os.path.abspath(flags.folder))
    prepare(trial)
    trial.run("sweep", trial.study("plain.yaml", {}), "-o", trial.at("plain"), "-q", "-j", "1")
    undisturbed = trial.rows(trial.at("plain"))[0]
    if len(undisturbed) != 3:
        trial.fail(f"{len(undisturbed)} trials of the undisturbed sweep, not 3")

    study, results = sweep_all(trial, "all", WAYS, undisturbed, 2)
    try_again(trial, study, results)
    for how in (signal.SIGKILL, signal.SIGINT):
        break_off(trial, how)
    full_disk(trial, undisturbed)
    if not flags.quick:
        sweep_all(trial, "more_jobs", WAYS, undisturbed, 6)
        for way, of in WAYS.items():
            sweep_all(trial, "one", {way: of}, undisturbed, 1, code=0 if of[1] is None else 1)
            shutil.rmtree(trial.at("one_results"))
    print(f"{len(WAYS)} ways, {trial.failed} failures")
    return 1 if trial.failed else 0


if __name__ == "__main__":
    sys.exit(main())
