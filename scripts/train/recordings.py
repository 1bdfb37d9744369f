# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Recordings for training: varied homes seen from around their drives, by `mapscore record`.

A recording is made once and kept, under a name that holds home, seed and a digest of what it was made from.
"""

import concurrent.futures
import hashlib
import pathlib
import shutil
import subprocess

import yaml

from scenes import ROOT, SCENES, Variation
from views import views

# Study with the drive of each home. The cottage is seen by nobody before the score.
DRIVES = {"apartment": "demo", "home": "home", "cottage": "segmentation_cottage"}


def digest(home):
    """Eight digits of the scene, its drive and the scripts that vary and read it."""
    files = [SCENES / f"{home}.xml", SCENES / f"{home}.classes.yaml", ROOT / f"configs/{DRIVES[home]}.yaml",
             *(ROOT / f"scripts/train/{script}.py" for script in ("scenes", "views", "data"))]
    return hashlib.sha256(b"".join(f.read_bytes() for f in files)).hexdigest()[:8]


def waypoints_of(home):
    study = yaml.safe_load((ROOT / f"configs/{DRIVES[home]}.yaml").read_text())
    return study["trajectory"]["waypoints_m_deg"]


def run(command, folder):
    """Runs `mapscore record`; a failure ends in what it said."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode or not (folder / "recording.yaml").exists():
        shutil.rmtree(folder, ignore_errors=True)
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stderr.strip() or 'made no recording'}")


def varied(program, home, seed, frames, folder):
    """A varied home from `frames` viewpoints. Returns the folder of the recording."""
    made = pathlib.Path(folder) / f"{home}_{seed}_{frames}_{digest(home)}"
    if (made / "recording.yaml").exists():
        return made
    shutil.rmtree(made, ignore_errors=True)
    work = pathlib.Path(folder) / f"scene_{home}_{seed}"
    work.mkdir(parents=True, exist_ok=True)
    scene = work / f"{home}.xml"
    scene.write_text(Variation(SCENES / f"{home}.xml", seed).varied())
    shutil.copy(SCENES / f"{home}.classes.yaml", work)
    (work / "views.txt").write_text(views(waypoints_of(home), frames, seed))
    run([program, "record", scene, "--trajectory", work / "views.txt", "-o", made, "-j", "1", "-q"], made)
    shutil.rmtree(work)
    return made


def drive(program, home, folder, frames_per_s=1.4):
    """The committed drive of a home as it is, which the scores are of."""
    made = pathlib.Path(folder) / f"{home}_drive_{frames_per_s:g}_{digest(home)}"
    if not (made / "recording.yaml").exists():
        shutil.rmtree(made, ignore_errors=True)
        run([program, "record", ROOT / f"configs/{DRIVES[home]}.yaml", "-o", made, "-q", "-j", "1",
             "--set", f"trajectory.frames_per_s={frames_per_s}", "--set", "trajectory.drive=poses",
             "--set", "sweep={}"], made)
    return made


def varied_all(program, homes, frames, folder, jobs):
    """Recordings of (home, seed) in order, `jobs` at once."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(lambda h: varied(program, *h, frames, folder), homes))
