#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A sweep on a real Slurm of two nodes, on loopback, with a task and a node killed on the way.

    /usr/bin/python3 -B tests/slurm/trial.py build/release/mapscore FOLDER [--study FILE] [--seeds N]

As root, with `apt-get install --no-install-recommends slurm-wlm munge`. The tidy CSV of a sweep in one process is held,
byte for byte, against --jobs 2, against shards of 1, 3 and 7, and against `sweep --slurm`, in which
  - the program of one task is killed (SIGKILL): its script runs it once more;
  - all of another task is killed: the merge has to name what is missing, and the next `--slurm` submits just that;
  - a node's slurmd is killed while its tasks go on: Slurm gives the node up and requeues them, so they run twice at once;
  - a third task is run a second time by hand under another host's name, as if the file system's locks did not reach it.
Ends with 1 where anything differs. The cluster's files are below FOLDER/cluster; it is stopped in any case.
"""

import argparse
import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))


class Trial:
    def __init__(self, program, folder, study, seeds):
        self.program, self.folder = os.path.abspath(program), os.path.abspath(folder)
        self.study = [os.path.abspath(study), "--set", f"seeds={seeds}"]
        self.failures = 0

    def at(self, name):
        return os.path.join(self.folder, name)

    def run(self, *words, code=0):
        done = subprocess.run([self.program, *words], capture_output=True, text=True)
        if done.returncode != code:
            self.say(False, f"{' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()}")
        return done.stdout + done.stderr

    def sweep(self, name, *flags, code=0):
        return self.run("sweep", *self.study, "-o", self.at(name), *flags, code=code)

    def tidy(self, name):
        return self.run("table", self.at(name), "--tidy")

    def say(self, good, text):
        self.failures += not good
        print(("ok    " if good else "WRONG ") + text, flush=True)

    def compare(self, name, what):
        rows = self.tidy(name)
        self.say(rows == self.expected, f"{what}: CSV of {len(rows)} bytes, {trials_in(self.at(name))} trials")

    def cluster(self, verb):
        subprocess.run([os.path.join(HERE, "local_slurm.sh"), verb, self.at("cluster")], check=True,
                       env=dict(os.environ, SLURMD_TIMEOUT="10"))


def trials_in(results):
    with sqlite3.connect(f"file:{results}/results.sqlite?mode=ro", uri=True) as store:
        return store.execute("SELECT count(*) FROM trials").fetchone()[0]


def tasks_of(results):
    """Processes of array tasks, by the task's number: [(process, program, node)]."""
    found = {}
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/environ", "rb") as file:
                words = dict(w.split(b"=", 1) for w in file.read().split(b"\0") if b"=" in w)
            with open(f"/proc/{process}/cmdline", "rb") as file:
                command = file.read()
        except OSError:
            continue
        task = words.get(b"SLURM_ARRAY_TASK_ID")
        if task and results.encode() in command:
            found.setdefault(int(task), []).append((int(process), command, words[b"SLURMD_NODENAME"].decode()))
    return found


def kill(processes):
    for process in processes:
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            pass


def wait_for(what, seconds=300):
    end = time.time() + seconds
    while time.time() < end:
        value = what()
        if value:
            return value
        time.sleep(0.1)
    raise SystemExit("WRONG waited in vain")


def queue():
    return subprocess.run(["squeue", "-h", "-r", "-o", "%i %j %T %N"], capture_output=True, text=True).stdout


def merge_log(results):
    with open(f"{results}/slurm/jobs.json") as file:
        number = json.load(file)["merge"]
    with open(f"{results}/slurm/{number}_merge.log") as file:
        return file.read().strip()


def runs_that_compute(results, on=None):
    """Tasks of which a store is being filled, by number."""
    return {task: processes for task, processes in tasks_of(results).items()
            if any(b"sweep" in command and b"/sh" not in command[:8] for _, command, node in processes)
            and (on is None or processes[0][2] == on)
            and any(name.startswith(f"{task}-of-") and os.path.exists(f"{results}/shards/{name}/status.json")
                    for name in os.listdir(f"{results}/shards"))}


def disturb(trial, results):
    """Kills on the way; see above."""
    def two_on_each():
        computing = {node: runs_that_compute(results, node) for node in ("n0", "n1")}
        return computing if len(computing["n0"]) >= 2 and computing["n1"] else None
    wait_for(lambda: os.path.isdir(f"{results}/shards"))
    computing = wait_for(two_on_each)
    once, lost = sorted(computing["n0"])[:2]
    kill(p for p, command, _ in computing["n0"][once] if b"sh\0" not in command[:16])
    print(f"      killed the program of task {once} on n0")
    kill(p for p, _, _ in computing["n0"][lost])
    print(f"      killed all of task {lost} on n0")
    with open(trial.at("cluster/pids")) as file:
        slurmd = next(int(line.split()[1]) for line in file if line.startswith("slurmd-n1 "))
    kill([slurmd])
    print(f"      killed slurmd of n1 under tasks {sorted(computing['n1'])}")
    print("      " + trial.run("status", results).strip().replace("\n", "\n      "), flush=True)
    again = sorted(computing["n1"])[0]
    with open(f"{results}/slurm/array.sh") as file:
        script = file.read()
    subprocess.run(["unshare", "--uts", "sh", "-c", "hostname elsewhere && exec sh -c \"$0\"", script], check=True,
                   env=dict(os.environ, SLURM_ARRAY_TASK_ID=str(again)), capture_output=True)
    print(f"      ran task {again} a second time, as host elsewhere")
    return lost


def on_slurm(trial):
    results = trial.at("slurm")
    print("      " + trial.sweep("slurm", "--slurm", "--tasks", "8", "--", "--mem=100").strip().replace("\n", "\n      "))
    lost = disturb(trial, results)
    seen = set()
    def over():
        lines = queue()
        seen.update(line.split()[2] for line in lines.splitlines())
        return not lines
    wait_for(over, 600)
    print(f"      states seen in the queue: {', '.join(sorted(seen))}")
    said = merge_log(results)
    print("      merge: " + said.replace("\n", "\n             "))
    trial.say(f"of shard {lost}/8" in said and "goes on" in said, "the merge names the lost task")
    print("      " + trial.run("status", results).strip().replace("\n", "\n      "))
    subprocess.run(["scontrol", "update", "nodename=n1", "state=resume"], capture_output=True)
    print("      " + trial.sweep("slurm", "--slurm", "--tasks", "8", "--", "--mem=100").strip().replace("\n", "\n      "))
    wait_for(lambda: not queue(), 600)
    print("      merge: " + merge_log(results).replace("\n", "\n             "))
    trial.compare("slurm", "Slurm, with a task, a program and a node killed")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--study", default=os.path.join(HERE, "../../configs/demo.yaml"))
    parser.add_argument("--seeds", type=int, default=30)
    flags = parser.parse_args()
    trial = Trial(flags.program, flags.folder, flags.study, flags.seeds)
    shutil.rmtree(trial.folder, ignore_errors=True)
    os.makedirs(trial.folder)
    trial.sweep("local", "-q", "--jobs", "1")
    trial.expected = trial.tidy("local")
    trial.compare("local", "one process, --jobs 1")
    trial.sweep("two", "-q", "--jobs", "2")
    trial.compare("two", "one process, --jobs 2")
    for shards in (1, 3, 7):
        for shard in range(1, shards + 1):
            trial.sweep(f"shards{shards}", "-q", "--jobs", "1", "--shard", f"{shard}/{shards}")
        trial.sweep(f"shards{shards}", "-q", "--merge_only")
        trial.compare(f"shards{shards}", f"{shards} shard{'s' if shards > 1 else ''}")
    os.environ["SLURM_CONF"] = trial.at("cluster/slurm.conf")
    trial.cluster("start")
    try:
        on_slurm(trial)
    finally:
        trial.cluster("stop")
    sys.exit(1 if trial.failures else 0)


if __name__ == "__main__":
    main()
