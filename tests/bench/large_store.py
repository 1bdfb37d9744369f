#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Size of a results folder of 10,000 trials, and time and memory of the verbs that read it.

    tests/bench/large_store.py build/release/mapscore FOLDER [--doses 5] [--seeds 667]

Sweeps configs/demo.yaml into FOLDER/demo, with its six seeds (kept for the next time). FOLDER/large is the same study with
more seeds, and doses evenly from 0 to 40 mm: the program says which trials it has, and each takes the result of the
demo's trial of the same method at the nearest dose, with the same seed modulo six. Run it on a machine that does nothing
else. Bars, at 10,000 trials: 60 MB; 5 s and 300 MB for status, table and figures, these without pictures of maps, which
are made from the recording.
"""

import argparse
import csv
import io
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import time

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
DEMO = os.path.join(SOURCE, "configs", "demo.yaml")
DOSE = "faults.misregistration.magnitude_m"
BAR_MB, BAR_S, BAR_MEMORY_MB = 60, 5, 300


def trials_of(program, folder):
    text = subprocess.run([program, "trials", folder, "--format", "csv"], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(io.StringIO(text)))


def swept(program, folder):
    if not os.path.exists(os.path.join(folder, "results.sqlite")):
        subprocess.run([program, "sweep", DEMO, "-o", folder, "-q"], check=True)
    return folder


def enlarged(program, demo, folder, doses, seeds):
    """The demo's store with more trials, in another folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shutil.copy(os.path.join(demo, "results.sqlite"), folder)
    store = sqlite3.connect(os.path.join(folder, "results.sqlite"))
    study = store.execute("SELECT value FROM texts WHERE name = 'study'").fetchone()[0]
    swept_doses = ", ".join(f"{0.04 * n / (doses - 1):g}" for n in range(doses))
    if doses != 5:
        study = re.sub(rf"{re.escape(DOSE)}: .*", f"{DOSE}: [{swept_doses}]", study)
    store.execute("UPDATE texts SET value = ? WHERE name = 'study'", [re.sub(r"(?m)^seeds: .*", f"seeds: {seeds}", study)])
    store.commit()
    fill(store, trials_of(program, demo), trials_of(program, folder))
    store.close()
    return folder


def fill(store, there, wanted):
    """Adds the trials of `wanted` that are not there."""
    rows = {key: rest for key, *rest in store.execute("SELECT key, description, result, build FROM trials")}
    seeds = 1 + max(int(trial["seed"]) for trial in there)

    def like(trial):
        """Of a lattice ceiling the method, and of all the dose, only tell which is shown first."""
        same = [of for of in there if of["seed"] == str(int(trial["seed"]) % seeds) and of["role"] == trial["role"]
                and (of["role"] == "lattice_ceiling" or of["method"] == trial["method"])]
        return min(same, key=lambda of: abs(float(of[DOSE]) - float(trial[DOSE])))

    for trial in wanted:
        if trial["key"] in rows:
            continue
        description, result, build = rows[like(trial)["key"]]
        description = re.sub(r"(?m)^seed_index: .*", f"seed_index: {trial['seed']}", description)
        store.execute("INSERT INTO trials VALUES (?, ?, ?, ?)", [trial["key"], description, result, build])
    store.commit()


def measured(command, output):
    """Seconds of the wall, processor seconds, MB of memory at most."""
    start = time.monotonic()
    with open(output, "wb") as out:
        process = subprocess.Popen(command, stdout=out)
        _, code, usage = os.wait4(process.pid, 0)
    if code != 0:
        sys.exit(f"{' '.join(command)}: failed")
    return time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def megabytes(path):
    files = [os.path.join(place, name) for place, _, names in os.walk(path) for name in names] if os.path.isdir(path) else [path]
    return sum(os.path.getsize(file) for file in files) / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--doses", type=int, default=5)
    parser.add_argument("--seeds", type=int, default=667)
    args = parser.parse_args()
    program = os.path.abspath(args.program)
    demo = swept(program, os.path.join(args.folder, "demo"))
    large = enlarged(program, demo, os.path.join(args.folder, "large"), args.doses, args.seeds)
    figures, printed = (os.path.join(args.folder, name) for name in ("figures", "printed"))
    shutil.rmtree(figures, ignore_errors=True)
    count = len(trials_of(program, large))
    store_mb = megabytes(os.path.join(large, "results.sqlite"))
    missed = store_mb > BAR_MB
    print(f"{count} trials and ceilings, {args.doses} doses, {args.seeds} seeds: {store_mb:.1f} MB")
    print("verb            wall s  processor s  memory MB  output MB")
    verbs = {"status": ["status", large], "table": ["table", large], "table --class": ["table", large, "--class", "chair"],
             "figures": ["figures", large, "--no_pictures", "-o", figures], "trials": ["trials", large],
             "compare": ["compare", large, "direct", "erosion"], "table --tidy": ["table", large, "--tidy"]}
    for name, verb in verbs.items():
        wall_s, cpu_s, memory_mb = measured([program, *verb], printed)
        written = megabytes(printed) + (megabytes(figures) if name == "figures" else 0)
        print(f"{name:14}  {wall_s:6.2f}  {cpu_s:11.2f}  {memory_mb:9.0f}  {written:9.2f}", flush=True)
        missed |= name in ("status", "table", "figures") and (wall_s > BAR_S or memory_mb > BAR_MEMORY_MB)
    sys.exit("a bar was missed" if missed else 0)


if __name__ == "__main__":
    main()
