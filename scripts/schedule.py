#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""How well a sweep of many trials would keep many workers busy: measured tasks, simulated schedule.

    scripts/schedule.py build/release/mapscore STUDY FOLDER [--seeds 625] [--jobs 1] [--tasks 256,512] [--workers 64,256]

A task is a process of so many jobs (workers that share decoded images and truths). Of the study with so many seeds some
tasks of each number are run, by `mapscore sweep --shard i/n --jobs JOBS`, and their wall time taken, with all that a process
does beside trials (start, decoding, truths) and with jobs that wait for the last. The reference is what a worker needs for
a trial in long processes of one job, as many of them at once as a task has jobs, so that both have the same share of the
machine. A schedule then hands tasks out in their order, each to the first JOBS workers that are free, with the measured
times drawn anew for tasks that were not measured. Efficiency: the time one worker needs for all trials, by workers times
the end of the last task. Drawn 200 times; median and least are printed. Run it on a machine that does nothing else.
"""

import argparse
import heapq
import os
import random
import shutil
import subprocess
import sys
import time


def seconds_of(*commands, codes=(0,)):
    """Wall seconds until the last of commands that run at once has ended, and what the first printed."""
    start = time.monotonic()
    running = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for command in commands]
    printed = [process.communicate() for process in running]
    if any(process.returncode not in codes for process in running):
        sys.exit(printed[0][1].strip())
    return time.monotonic() - start, printed[0][0]


def end_of_schedule(times, slots):
    free = [0.0] * slots
    for seconds in times:
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return max(free)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("study")
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=625)
    parser.add_argument("--jobs", type=int, default=1, help="workers of a task")
    parser.add_argument("--tasks", default="256,512,1000")
    parser.add_argument("--workers", default="64,128,256")
    parser.add_argument("--sample", type=int, default=6, help="tasks that are measured of each number")
    parser.add_argument("--reference", type=int, default=40, help="the reference is one of so many shards")
    flags = parser.parse_args()

    def sweep(folder, jobs):
        return [flags.program, "sweep", flags.study, "--set", f"seeds={flags.seeds}", "-o", folder, "-q", "-j", str(jobs)]
    tasks_in = sweep(flags.folder, flags.jobs)
    seconds_of(tasks_in + ["--merge_only"], codes=(0, 1))  # the recording
    trials = int(seconds_of(tasks_in + ["--dry_run"])[1].split(" with ceilings")[0].split()[-1])
    alone = [sweep(os.path.join(flags.folder, "alone", str(n)), 1) for n in range(flags.jobs)]
    for command in alone:
        folder = command[command.index("-o") + 1]
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(os.path.join(flags.folder, "recordings"), os.path.join(folder, "recordings"))
    reference, _ = seconds_of(*[command + ["--shard", f"1/{flags.reference}"] for command in alone])
    reference *= flags.reference / trials
    print(f"{trials} trials and ceilings, {reference:.3f} seconds each in one process of one job")
    print("tasks  trials of a task  seconds of a task: mean, least, most  workers  efficiency: median, least")
    for tasks in map(int, flags.tasks.split(",")):
        measured = []
        for k in range(flags.sample):
            shard = f"{round((k + 0.5) * tasks / flags.sample) + 1}/{tasks}"
            measured.append(seconds_of(tasks_in + ["--shard", shard])[0])
        for workers in map(int, flags.workers.split(",")):
            draw = random.Random(1)
            efficiencies = sorted(
                reference * trials / workers / end_of_schedule(draw.choices(measured, k=tasks), workers // flags.jobs)
                for _ in range(200))
            print(f"{tasks:5}  {trials / tasks:16.1f}  {sum(measured) / len(measured):23.2f}, {min(measured):.2f}, "
                  f"{max(measured):.2f}  {workers:7}  {efficiencies[100]:18.3f}, {efficiencies[0]:.3f}", flush=True)


if __name__ == "__main__":
    main()
