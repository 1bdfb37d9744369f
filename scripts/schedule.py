#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""How well a sweep of many trials would keep many workers busy: measured tasks, simulated schedule.

    scripts/schedule.py build/release/mapscore STUDY FOLDER [--seeds 625] [--tasks 256,512,1000] [--workers 64,128,256]

Of the study with so many seeds, some shards of each number of tasks are computed, by `mapscore sweep --shard i/n --jobs 1`,
and their processor seconds taken, with all that a process does beside trials (start, decoding, truths). The reference is
the same of one longer process: what one worker needs for a trial. A schedule then hands tasks out in their order, each to
the first worker that is free, with the measured times drawn anew for tasks that were not measured. Efficiency: the time
one worker needs for all trials, by workers times the end of the last task. Drawn 200 times; median and least are printed.
"""

import argparse
import heapq
import random
import resource
import subprocess
import sys


def processor_seconds(words, codes=(0,)):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in codes:
        sys.exit(done.stderr.strip())
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def end_of_schedule(times, workers):
    free = [0.0] * workers
    for seconds in times:
        heapq.heappush(free, heapq.heappop(free) + seconds)
    return max(free)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("study")
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=625)
    parser.add_argument("--tasks", default="256,512,1000")
    parser.add_argument("--workers", default="64,128,256")
    parser.add_argument("--sample", type=int, default=6, help="tasks that are measured of each number")
    parser.add_argument("--reference", type=int, default=40, help="the reference is one of so many shards")
    flags = parser.parse_args()
    sweep = [flags.program, "sweep", flags.study, "--set", f"seeds={flags.seeds}", "-o", flags.folder, "-q", "-j", "1"]
    processor_seconds(sweep + ["--merge_only"], (0, 1))  # the recording
    trials = int(processor_seconds(sweep + ["--dry_run"])[1].split(" with ceilings")[0].split()[-1])

    def shard(i, n):
        return processor_seconds(sweep + ["--shard", f"{i}/{n}"])[0]
    reference = shard(1, flags.reference) * flags.reference / trials
    print(f"{trials} trials and ceilings, {reference:.3f} processor seconds each in one process")
    print("tasks  trials of a task  seconds of a task: mean, least, most  workers  efficiency: median, least")
    for tasks in map(int, flags.tasks.split(",")):
        measured = [shard(round((k + 0.5) * tasks / flags.sample) + 1, tasks) for k in range(flags.sample)]
        for workers in map(int, flags.workers.split(",")):
            draw = random.Random(1)
            efficiencies = sorted(
                reference * trials / workers / end_of_schedule(draw.choices(measured, k=tasks), workers)
                for _ in range(200))
            print(f"{tasks:5}  {trials / tasks:16.1f}  {sum(measured) / len(measured):23.2f}, {min(measured):.2f}, "
                  f"{max(measured):.2f}  {workers:7}  {efficiencies[100]:18.3f}, {efficiencies[0]:.3f}", flush=True)


if __name__ == "__main__":
    main()
