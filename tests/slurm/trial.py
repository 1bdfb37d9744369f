#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""A sweep on a real Slurm of two nodes, on loopback, with a task and a node killed on the way.

    /usr/bin/python3 -B tests/slurm/trial.py build/release/mapscore FOLDER [--study FILE] [--seeds N]

As root, with `apt-get install --no-install-recommends slurm-wlm munge`. The tidy CSV of a sweep in one process is held,
byte for byte, against --jobs 2, against shards of 1, 3 and 7, and against `sweep --slurm`, in which
  - the program of one task is killed (SIGKILL): its script runs it once more;
  - all of another task is killed: the merge has to name what is missing, and the next `--slurm` submits just that;
  - a node is killed but for the program of one task: Slurm gives the node up and requeues its tasks, so one runs twice;
  - that task is run a third time by hand under another host's name, as if the file system's locks did not reach it.
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


class Task:
    """The processes of an array task on a node: its script, what that runs, and the slurmstepd above."""

    def __init__(self, node):
        self.node, self.scripts, self.programs, self.daemons = node, [], [], []

    def all(self):
        return self.daemons + self.scripts + self.programs


def tasks_of(conf):
    """Those under way on this cluster, by number."""
    found = {}
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/environ", "rb") as file:
                words = dict(w.split(b"=", 1) for w in file.read().split(b"\0") if b"=" in w)
            with open(f"/proc/{process}/cmdline", "rb") as file:
                command = file.read()
            with open(f"/proc/{process}/stat") as file:
                parent = int(file.read().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue
        if words.get(b"SLURM_CONF", b"").decode() != conf or b"SLURM_ARRAY_TASK_ID" not in words:
            continue
        task = found.setdefault(int(words[b"SLURM_ARRAY_TASK_ID"]), Task(words[b"SLURMD_NODENAME"].decode()))
        if b"\0sweep\0" in command:
            task.programs.append(int(process))
        elif b"slurm_script" in command:
            task.scripts.append(int(process))
            task.daemons.append(parent)
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


def computing(results, node):
    """Tasks of a node whose program and status are there, by number."""
    begun = {int(name.split("-")[0]) for name in os.listdir(f"{results}/shards")
             if os.path.exists(f"{results}/shards/{name}/status.json")}
    return {number: task for number, task in tasks_of(os.environ["SLURM_CONF"]).items()
            if task.node == node and task.programs and task.scripts and number in begun}


def disturb(trial, results):
    """Kills on the way; see above. The number of the task that is lost."""
    def two_on_each():
        nodes = [computing(results, node) for node in ("n0", "n1")]
        return nodes if min(map(len, nodes)) >= 2 else None
    wait_for(lambda: os.path.isdir(f"{results}/shards"))
    n0, n1 = wait_for(two_on_each)
    (once, lost), (orphan, dead) = sorted(n0)[:2], sorted(n1)[:2]
    with open(trial.at("cluster/pids")) as file:
        slurmd = next(int(line.split()[1]) for line in file if line.startswith("slurmd-n1 "))
    kill([slurmd, *n1[orphan].daemons, *n1[dead].all()])
    print(f"      killed n1 with task {dead}; the program of its task {orphan} goes on")
    kill(n0[lost].scripts + n0[lost].programs)
    print(f"      killed all of task {lost} on n0")
    kill(n0[once].programs)
    print(f"      killed the program of task {once} on n0")
    print("      " + trial.run("status", results).strip().replace("\n", "\n      "), flush=True)
    with open(f"{results}/slurm/array.sh") as file:
        script = file.read()
    subprocess.run(["unshare", "--uts", "sh", "-c", "hostname elsewhere && exec sh -c \"$0\"", script], check=True,
                   env=dict(os.environ, SLURM_ARRAY_TASK_ID=str(orphan)), capture_output=True)
    print(f"      ran task {orphan} a second time, as host elsewhere")
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
    show = subprocess.run(["scontrol", "-o", "show", "job"], capture_output=True, text=True).stdout
    words = [dict(w.split("=", 1) for w in line.split() if "=" in w) for line in show.splitlines()]
    ended = sorted((int(w["ArrayTaskId"]), f"{w['JobState']}, {w['Restarts']} restarts") for w in words
                   if w.get("ArrayTaskId", "").isdigit())
    print("      tasks: " + "; ".join(f"{task} {how}" for task, how in ended))
    trial.say(sum("1 restarts" in how for _, how in ended) >= 2, "Slurm requeued the tasks of the node")
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
