# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""The verbs over one recording or study, in the order in which people use them; a Case (bench.py) judges each run."""

import os

import tiny_files as tiny

TEXT_FORMATS = (("--format", "text"), ("--format", "csv"), ("--format", "json"))


def write_study(case, recording, ahead=b""):
    tiny.write(case.at("study.yaml"), ahead + tiny.STUDY % tiny.in_yaml(recording))
    return case.at("study.yaml")


def sweep_and_show(case, study, classes, full, results="results"):
    """What is made of a study: store, tables, figures, pictures."""
    folder = case.out(results)
    if not case.run("sweep", study, "-o", folder, "-q", "-j", "1"):
        return
    for flags in (TEXT_FORMATS if full else ()) + ((), ("--tidy",)):
        case.run("table", folder, *flags)
    for verb in ("info", "status", "trials"):
        case.run(verb, folder)
    case.run("figures", folder, *(() if full else ("--no_pictures",)))
    if not full:
        return
    for name in classes:
        case.run("table", folder, b"--class=" + name)
        case.run("compare", folder, "direct", "erosion", b"--group=" + name)
    for flags in TEXT_FORMATS:
        case.run("compare", folder, "direct", "erosion", *flags)
    baseline = case.out("baseline.json")
    case.run("check", folder, "--baseline", baseline, "--update")
    case.run("check", folder, "--baseline", baseline)
    case.run("run", study, "-o", folder, "-q", "-j", "1")


def tolerance_of(case, study, results="tolerance"):
    """A folder that no sweep has bound to a study: only `info` says what it holds."""
    folder = case.out(results)
    if not case.run("tolerance", study, "-o", folder, "--trials", "24", "--group", "all", "--figure", case.out("t"), "-q",
                    "-j", "1"):
        return
    case.run("info", folder)
    for verb in ("status", "trials", "table", "figures"):
        case.run(verb, folder, codes=(2,))


def frames_of(case, study):
    case.run("frames", study, "-o", case.out("frames"), "-q", "-j", "1", "--set", "score.unit=frame")


def trial_of(case, study):
    folder = case.out("trial")
    if case.run("trial", study, "-o", folder, "-q", "--set", "sweep={}", "--set", "faults.labels.boundary_px=1"):
        case.run("map", folder, "-o", case.out("trial.ot"), "-q")


def map_and_score(case, recording, full):
    map_file = case.out("map.ot")
    case.run("map", recording, "-o", map_file, "--color", case.out("colour.ot"), "--ply", case.out("map.ply"), "-q")
    scored = ("--truth", recording, "-q", "-j", "1")
    case.run("score", map_file, *scored)
    case.run("score", map_file, *scored, "--tidy")
    if not full:
        return
    for flags in (("--format", "csv"), ("--format", "json"), ("--details",), ("--details", "--format", "json")):
        case.run("score", map_file, *scored, *flags)
    case.run("score", map_file, *scored, "--picture", case.out("errors.png"), "--errors_ply", case.out("errors.ply"))
    for flags in TEXT_FORMATS:
        case.run("resolutions", map_file, *scored, *flags, "--times", "1,2")
    case.run("resolutions", map_file, *scored, "--picture", case.out("sizes.png"), "--color", case.out("sizes.ot"))
    for ending in (".csv", ".ply"):
        case.run("truth", recording, "-o", case.out("truth" + ending), "-q", "-j", "1")
        if case.run("score", case.out("truth" + ending), *scored, "--format", "csv"):
            rows = [line for line in case.printed.splitlines() if line and not line.startswith(b"#")]
            if b",1.000,1.000,1.000,1.000," not in rows[-1] and case.must_work:
                case.fail(f"a truth{ending} read back is not the truth: {rows[-1]!r}")
        case.run("info", case.out("truth" + ending))
    case.run("info", map_file)
    case.run("info", case.out("map.ply"))


def objects_of(case, recording):
    for flags in TEXT_FORMATS:
        case.run("objects", recording, "-o", case.out("objects"), "-q", "--min_points", "5", *flags)
    if os.path.exists(case.out("objects/objects.yaml")):
        case.run("objects", recording, "-o", case.out("more"), "-q", "--start", case.out("objects/objects.yaml"))
        case.run("info", case.out("objects/objects.xml"), "--no_picture")


def whole_recording(case, recording, classes, full):
    if not case.run("info", recording) and not case.must_work:
        case.run("sweep", case.at("study.yaml"), "-o", case.out("results"), "-q")
        case.run("map", recording, "-o", case.out("map.ot"), "-q")
        return
    sweep_and_show(case, case.at("study.yaml"), classes, full)
    if full:
        tolerance_of(case, case.at("study.yaml"))
    frames_of(case, case.at("study.yaml"))
    trial_of(case, case.at("study.yaml"))
    map_and_score(case, recording, full)
    if full:
        case.run("segment", recording, "-o", case.out("segments"))
        objects_of(case, recording)
        case.run("localize", recording, "-o", case.out("localized"), "-q")
