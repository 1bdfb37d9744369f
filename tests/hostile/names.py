#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Carries sixty hostile names through every place where a name can stand, and every verb that reads it there.

    /usr/bin/python3 -B tests/hostile/names.py build/release/mapscore FOLDER            all names, places, verbs
    /usr/bin/python3 -B tests/hostile/names.py build/release/mapscore FOLDER --quick    what CI runs

FOLDER is for work, made when it is not there; what is in FOLDER/cases is removed. Needs numpy, PIL, yaml; figures are
drawn where gnuplot is installed; where strace is installed, full runs are traced (--no-trace leaves that out).

A name may be refused, in one line and with exit code 2, when it holds control characters, no UTF-8, characters that
change the direction of writing, blanks at its ends, or 10 kB; every other one has to be accepted as that of a class.
What every run is held against stands in program.py and bench.py: nothing but gnuplot is started, nothing but the output
is written, nothing raw reaches the terminal, and what is written is well-formed. One line a failure; exit code 1 with
any. --only PLACE runs one place alone.
"""

import argparse
import concurrent.futures
import errno
import os
import shutil
import sys
import time

from bench import Case
from hostile_names import NAMES
from places import BATCHED, NEEDS_A_FILE_NAME, QUICK, SINGLE
from program import Failures, Program, shown

BATCH = 8


def batches(names):
    """Names that have to work stand together; one that may be refused would hide what the others do."""
    working = [name for name in names if name.works]
    return [working[n:n + BATCH] for n in range(0, len(working), BATCH)] + [[name] for name in names if not name.works]


def work_list(quick, only):
    """[(place, names, must work)]"""
    work = []
    for place in BATCHED:
        for batch in batches(NAMES):
            work.append((place, batch, batch[0].works and len(batch) > 0))
    for place in SINGLE:
        if quick and place not in QUICK:
            continue
        for name in NAMES:
            if place in NEEDS_A_FILE_NAME and name.as_file() is None:
                continue
            work.append((place, [name], False))
    if quick:
        work = [row for n, row in enumerate(work) if row[0] == "classes of a recording" or
                n % (3 if row[0] in BATCHED else 20) == 0]
    return [row for row in work if not only or row[0] == only]


def carry(program, row, full, traced):
    place, names, must_work = row
    label = f"{place} [{names[0].tag}{f' ... {names[-1].tag}' if len(names) > 1 else ''}]"
    with Case(program, label, must_work, traced, by_hand=full) as case:
        try:
            if place in BATCHED:
                BATCHED[place](case, names, full)
            else:
                SINGLE[place](case, names[0], full)
        except OSError as error:  # a name that this file system cannot hold
            if case.ran == 0 and error.errno in (errno.ENAMETOOLONG, errno.EILSEQ, errno.EINVAL):
                return f"{label}: left out: {error.strerror}"
            case.fail(f"the test itself: {error}")
        except Exception as error:  # pylint: disable=broad-except  # whatever it is, the other cases go on
            case.fail(f"the test itself: {type(error).__name__}: {shown(error)}")
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", choices=[*BATCHED, *SINGLE])
    parser.add_argument("--no-trace", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    flags = parser.parse_args()
    start = time.monotonic()
    shutil.rmtree(os.path.join(flags.folder, "cases"), ignore_errors=True)
    os.makedirs(os.path.join(flags.folder, "cases"))
    failures = Failures()
    program = Program(flags.program, flags.folder, failures)
    traced = not flags.quick and not flags.no_trace and os.path.exists("/usr/bin/strace")
    work = work_list(flags.quick, flags.only)
    with concurrent.futures.ThreadPoolExecutor(flags.jobs) as pool:
        jobs = [pool.submit(carry, program, row, not flags.quick, traced) for row in work]
        for job in jobs:
            left_out = job.result()
            if left_out:
                print(left_out)
    if program.beside:
        failures.add(f"{len(program.beside)} cases wrote into the home folder, such as {program.beside[0]}")
    print(f"{failures.runs} runs in {time.monotonic() - start:.0f} s, {failures.refusals} of them refused, over {len(work)} "
          f"cases{', traced' if traced else ''}{'' if program.gnuplot else '; no gnuplot, hence no figures'}: "
          f"{len(failures.lines)} failures")
    return 1 if failures.lines else 0


if __name__ == "__main__":
    sys.exit(main())
