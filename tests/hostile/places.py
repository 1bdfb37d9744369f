# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Where a name can stand, and the verbs that read it there.

A place is a function of a Case and names. Those of BATCHED take up to eight names at once (classes of one recording),
those of SINGLE one. `full` chooses between every verb with every format and the few that print and draw names.
"""

import json
import os
import sqlite3

import yaml

import tiny_files as tiny
from verbs import TEXT_FORMATS, frames_of, sweep_and_show, whole_recording, write_study

# --- places that hold several names at once


def in_a_recording(case, names, full):
    texts = [name.text for name in names]
    tiny.write_recording(case.at("recording"), texts, geoms=texts)
    write_study(case, b"recording")
    whole_recording(case, case.at("recording"), texts, full)


def in_a_scene(case, names, full):
    """Class file, bodies, geoms and meshes of a scene, and of what is recorded from it."""
    texts = [name.text for name in names]
    tiny.write_scene(case.at(""), classes=texts, bodies=texts if full else None, geoms=texts, meshes=texts)
    scene, folder = case.at("room.xml"), case.out("recorded")
    case.run("info", scene, "--picture", case.out("scene.png"))
    case.run("info", scene, "--suggest_classes", "-o", case.out("suggested.classes.yaml"))
    if full:
        case.run("truth", scene, "-o", case.out("truth.csv"), "-q", "-j", "1")
    if not case.run("record", case.at("study.yaml"), "-o", folder, "-q", "-j", "1"):
        return
    if case.must_work:
        with open(os.path.join(folder, "recording.yaml"), encoding="utf-8") as file:
            read = [entry["name"] for entry in yaml.safe_load(file)["classes"][1:]]
        if read != [text.decode("utf-8") for text in texts]:
            case.fail(f"recording.yaml names other classes than the class file: {read!r}")
    case.run("info", folder)
    if full:
        case.run("segment", folder, "-o", case.out("segments"))
        case.run("sweep", case.at("study.yaml"), "-o", case.out("results"), "-q", "-j", "1")
        case.run("figures", case.out("results"))


def in_a_foreign_folder(case, names, _):
    texts = [name.text for name in names]
    tiny.write_foreign(case.at("foreign"), texts)
    case.run("map", case.at("foreign"), "--intrinsics", "64,64,31.5,23.5", "--classes", case.at("foreign/classes.yaml"),
             "-o", case.out("map.ot"), "--ply", case.out("map.ply"), "-q")
    case.run("info", case.out("map.ply"), codes=(0, 2))


def in_a_map_table(case, names, _):
    """The class column of a CSV map, known to the truth and not."""
    texts = [name.text for name in names]
    tiny.write_recording(case.at("recording"), texts)
    tiny.write_recording(case.at("other"), [b"crate"])
    rows = b"".join(b"%d,%d,15,%s\n" % (40 + n // 3, n % 3, tiny.in_csv(text)) for n, text in enumerate(texts))
    tiny.write(case.at("map.csv"), b"i,j,k,class\n" + rows)
    tiny.write(case.at("legend.yaml"), b"names: {" + b", ".join(tiny.in_yaml(text) + b": crate" for text in texts) + b"}\n")
    case.run("info", case.at("map.csv"))
    for truth, flags in (("recording", ()), ("recording", ("--tidy",)), ("other", ("--legend", case.at("legend.yaml")))):
        case.run("score", case.at("map.csv"), "--truth", case.at(truth), "--trust_frame", "-q", *flags)
    case.run("score", case.at("map.csv"), "--truth", case.at("other"), "--trust_frame", codes=(0, 2))


def in_a_legend(case, names, _):
    texts = [name.text for name in names]
    tiny.write_recording(case.at("recording"), texts)
    tiny.write(case.at("map.csv"), b"i,j,k,class\n" + b"".join(b"%d,0,15,%d\n" % (40 + n, n) for n in range(len(texts))))
    tiny.write(case.at("legend.yaml"),
               b"ids: {" + b", ".join(b"%d: %s" % (n, tiny.in_yaml(text)) for n, text in enumerate(texts)) + b"}\n")
    case.run("score", case.at("map.csv"), "--truth", case.at("recording"), "--trust_frame", "--legend",
             case.at("legend.yaml"), "--format", "csv", "-q")


BATCHED = {"classes of a recording": in_a_recording, "scene": in_a_scene, "foreign class file": in_a_foreign_folder,
           "class column of a map": in_a_map_table, "legend": in_a_legend}


# --- places of one name


def crate_study(case, ahead=b""):
    tiny.write_recording(case.at("recording"))
    return write_study(case, b"recording", ahead)


def as_a_study_name(case, name, full):
    sweep_and_show(case, crate_study(case, b"name: " + tiny.in_yaml(name.text) + b"\n"), (), full)
    frames_of(case, case.at("study.yaml"))


def as_a_title(case, name, full):
    """Of a class and of a method."""
    tiny.write_recording(case.at("recording"))
    title = tiny.in_yaml(name.text)
    study = case.at("study.yaml")
    tiny.write(study, (tiny.STUDY % b"recording").replace(b"direct: {", b"direct: {title: " + title + b", ", 1) +
               b"class_titles: {crate: " + title + b"}\n")
    sweep_and_show(case, study, (), full)
    for form in ("markdown", "tex"):
        case.run("table", case.out("results"), "--rows", "class,method", "--format", form)
    case.run("figures", case.out("results"), "--no_pictures", "--width_mm", "85", "--grey")
    frames_of(case, study)


def as_a_method(case, name, _):
    tiny.write_recording(case.at("recording"))
    tiny.write(case.at("study.yaml"), b"recording: recording\nmethods:\n  ? " + tiny.in_yaml(name.text) +
               b"\n  : {segmentation: {direct: {}}}\n")
    if case.run("sweep", case.at("study.yaml"), "-o", case.out("results"), "-q"):
        case.run("figures", case.out("results"), "--no_pictures")


def as_a_study_file(case, name, full):
    os.rename(crate_study(case), case.at(name.as_file() + b".yaml"))
    sweep_and_show(case, case.at(name.as_file() + b".yaml"), (), full)
    frames_of(case, case.at(name.as_file() + b".yaml"))


def as_a_scene_file(case, name, full):
    tiny.write_scene(case.at(""), file=name.as_file() + b".xml")
    case.run("info", case.at(name.as_file() + b".xml"), "--no_picture")
    if case.run("record", case.at("study.yaml"), "-o", case.out("recorded"), "-q", "-j", "1"):
        case.run("info", case.out("recorded"))
    case.run("sweep", case.at("study.yaml"), "-o", case.out("results"), "-q", "-j", "1")
    if full:
        case.run("figures", case.out("results"), codes=(0, 2))


def as_a_recording_folder(case, name, full):
    tiny.write_recording(case.at(name.as_file()))
    write_study(case, name.as_file())
    whole_recording(case, case.at(name.as_file()), (), full)
    if not full:
        case.run("localize", case.at(name.as_file()), "-o", case.out("localized"), "-q")


def as_a_results_folder(case, name, full):
    sweep_and_show(case, crate_study(case), (), full, name.as_file())
    case.run("record", case.at("study.yaml"), "-o", case.out(b"r" + name.as_file()), codes=(0, 2))


def as_a_map_file(case, name, _):
    tiny.write_recording(case.at("recording"))
    file = name.as_file()
    case.run("map", case.at("recording"), "-o", case.out(file + b".ot"), "--ply", case.out(file + b".ply"), "-q")
    for ending in (b".ot", b".ply"):
        case.run("score", case.out(file + ending), "--truth", case.at("recording"), "-q", "--picture",
                 case.out(file + ending + b".png"), "--errors_ply", case.out(file + ending + b".errors.ply"))
        case.run("info", case.out(file + ending))
    case.run("truth", case.at("recording"), "-o", case.out(file + b".csv"), "-q")
    case.run("resolutions", case.out(file + b".ot"), "--truth", case.at("recording"), "-q", "--color", case.out(file + b"c.ot"))


def in_a_store(case, name, full):
    """Texts of a store that a stranger sends: classes, study, recording, version, and a trial's description."""
    if not case.run("sweep", crate_study(case), "-o", case.out("whole"), "-q", "-j", "1"):
        return
    text = name.text.decode("utf-8", "surrogateescape")
    def named(value, new):
        if isinstance(value, dict):
            return {key: new if key == "name" else named(part, new) for key, part in value.items()}
        return [named(part, new) for part in value] if isinstance(value, list) else value
    changes = {
        "classes": lambda old: json.dumps(named(json.loads(old), text)),
        "study": lambda old: yaml.safe_dump({**yaml.safe_load(old), "name": text.encode("utf-8", "replace").decode()},
                                            allow_unicode=True),
        "study_folder": lambda old: text, "recording": lambda old: text, "recording_hash": lambda old: text,
        "mapscore_version": lambda old: text, "format_version": lambda old: text}
    with open(case.out("whole/results.sqlite"), "rb") as file:
        whole = file.read()
    for what, change in changes.items():
        folder = case.out(f"store_{what}")
        os.makedirs(folder)
        tiny.write(folder + "/results.sqlite", whole)
        with sqlite3.connect(folder + "/results.sqlite") as store:
            old = store.execute("select value from texts where name = ?", (what,)).fetchone()[0]
            new = change(old)
            store.execute("update texts set value = cast(? as text) where name = ?",
                          (new.encode("utf-8", "surrogateescape"), what))
        store.close()
        case.run("info", folder)
        for flags in TEXT_FORMATS + (("--tidy",),) if full else (("--tidy",),):
            case.run("table", folder, *flags)
        if full or what in ("classes", "study"):
            case.run("figures", folder, "--no_pictures")
        if full:
            case.run("compare", folder, "direct", "erosion")
            case.run("check", folder, "--baseline", case.out("b.json"), "--update")
            case.run("sweep", case.at("study.yaml"), "-o", folder, "-j", "1", "--merge", case.out("whole"))


def in_comments(case, name, _):
    """Comments of point clouds, which are passed over, and names of fields that mean nothing."""
    tiny.write_recording(case.at("recording"))
    ply = b"ply\nformat ascii 1.0\ncomment %s\nobj_info %s\nelement vertex 1\nproperty float x\nproperty float y\n" \
          b"property float z\nproperty int label\nproperty float %s\nend_header\n2.02 0.6 0.75 1 0\n"
    pcd = b"# %s\nVERSION 0.7\nFIELDS x y z label %s\nSIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH 1\n" \
          b"HEIGHT 1\nPOINTS 1\nDATA ascii\n2.02 0.6 0.75 1 0\n"
    files = {"comment.ply": ply % (name.text, name.text, b"w"), "field.ply": ply % (b"c", b"c", name.text),
             "comment.pcd": pcd % (name.text, b"w"), "field.pcd": pcd % (b"c", name.text),
             "field.csv": b"x,y,z,class,%s\n2.02,0.6,0.75,1,0\n" % tiny.in_csv(name.text)}
    for file, text in files.items():
        tiny.write(case.at(file), text)
    for file in files:
        case.run("info", case.at(file))
        case.run("score", case.at(file), "--truth", case.at("recording"), "--trust_frame")


def as_an_image(case, name, full):
    study, file = crate_study(case), name.as_file()
    for kind in ("color", "depth", "label", "depth_label"):
        os.rename(case.at(f"recording/{kind}/000001.png"), case.at(f"recording/{kind}/".encode() + file))
    for listing in ("color", "depth"):
        with open(case.at(f"recording/{listing}.txt"), "rb") as old:
            text = old.read()
        tiny.write(case.at(f"recording/{listing}.txt"), text.replace(b"000001.png", name.text))
    case.run("info", case.at("recording"))
    case.run("sweep", study, "-o", case.out("results"), "-q")
    case.run("map", case.at("recording"), "-o", case.out("map.ot"), "-q")
    if full:
        case.run("segment", case.at("recording"), "-o", case.out("segments"), "--frame", "1")
        case.run("run", study, "-o", case.out("results"), "-q")


def in_objects(case, name, _):
    tiny.write_recording(case.at("recording"))
    for n, (kind, model) in enumerate(((b"crate", name.text), (name.text, b"a.obj"), (b"crate", name.text + b".xml"))):
        tiny.write(case.at(f"objects{n}.yaml"), b"format_version: 1\nmap_origin_m: [0, 0, 0]\nmap_yaw_deg: 0\nobjects:\n"
                   b"  - {id: 1, class: %s, T_map_object: [2, 0.6, 0.75, 0, 0, 0, 1], size_m: [0.2, 0.2, 0.2], last_seen_s: 0,"
                   b" observations: 3, misses: 0, age: 0, confidence: 0.5, model: %s}\n"
                   % (tiny.in_yaml(kind), tiny.in_yaml(model)))
    for n in range(3):
        case.run("objects", case.at("recording"), "-o", case.out(f"objects{n}"), "-q", "--start", case.at(f"objects{n}.yaml"))


def in_flags(case, name, _):
    """Where a flag's value comes back in a message."""
    study, text = crate_study(case), name.text
    recording = case.at("recording")
    tiny.write(case.at("grid.yaml"), b"image: %s\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
               b"free_thresh: 0.2\n%s: 1\n" % (tiny.in_yaml(text), tiny.in_yaml(text)))
    tiny.write(case.at("motion.csv"), b"stamp_s," + tiny.in_csv(text) + b"\n0,0\n")
    tiny.write(case.at("baseline.json"), b'{"format": 3, "study": "' + text.replace(b"\\", b"\\\\").replace(b'"', b'\\"') + b'"}')
    os.makedirs(case.at("scene"))
    tiny.write_scene(case.at("scene"))
    case.run(b"v" + text)
    case.run("sweep", study, "-o", case.out("r"), b"--set=" + text)
    case.run("sweep", study, "-o", case.out("r"), b"--set=name=" + text)
    case.run("run", study, "-o", case.out("r"), b"--method=" + text)
    case.run("map", recording, "-o", case.out("m.ot"), b"--detect=" + text)
    case.run("map", recording, "-o", case.out("m.ot"), b"--frames=" + text)
    case.run("score", recording + "/nothing.ply", "--truth", recording, b"--transform=" + text)
    case.run("localize", recording, "-o", case.out("l"), "-q", b"--grid=" + text)
    case.run("info", text)
    case.run("localize", recording, "-o", case.out("l"), "-q", "--grid", case.at("grid.yaml"))
    case.run("record", case.at("scene/study.yaml"), "-o", case.out("rec"), "-q", "--motion", case.at("motion.csv"))
    if case.run("sweep", study, "-o", case.out("r"), "-q"):
        case.run("check", case.out("r"), "--baseline", case.at("baseline.json"), codes=(2,))
        case.run("check", case.out("r"), "--baseline", case.out("made.json"), "--update")
        case.run("check", case.out("r"), "--baseline", case.out("made.json"), b"--allow=" + text + b"=1", codes=(2,))
        case.run("figures", case.out("r"), "--no_pictures", b"--trial=" + text)
        case.run("table", case.out("r"), b"--class=" + text)
        case.run("compare", case.out("r"), "--", "direct", text)
        case.run("compare", case.out("r"), "direct", "erosion", b"--metric=" + text)


SINGLE = {"study name": as_a_study_name, "title": as_a_title, "method": as_a_method, "study file": as_a_study_file,
          "scene file": as_a_scene_file, "recording folder": as_a_recording_folder, "results folder": as_a_results_folder,
          "map file": as_a_map_file, "store": in_a_store, "comments of maps": in_comments, "image": as_an_image,
          "objects": in_objects, "flags": in_flags}
NEEDS_A_FILE_NAME = {"study file", "scene file", "recording folder", "results folder", "map file", "image"}
QUICK = {"study name", "title", "recording folder", "store"}
