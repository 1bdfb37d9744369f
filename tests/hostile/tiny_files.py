# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Recordings, studies and scenes so small that a run of the program over them takes a tenth of a second.

The recording (docs/formats.md): up to eight crates, each of a class of its own, before the far wall of an empty room,
seen four times at 64 x 48 pixels by a robot that drives 0.3 m towards them, with odometry and turns of a lidar. Names
are bytes, and go into the files as they are where the format can hold them.
"""

import os
import struct

import numpy as np
from PIL import Image

SIZE, FOCAL, FRAMES = (48, 64), 64.0, 4
OPTICAL_TO_BASE = (-0.5, 0.5, -0.5, 0.5)  # x right, y down, z forward -> x forward, y left, z up
HEIGHT_M, LIDAR_M = 1.0, 0.2
ROOM = [((3.0, 3.1), (-2.1, 2.1), (-0.6, 3.0)), ((-1.1, -1.0), (-2.1, 2.1), (-0.6, 3.0)),
        ((-1.1, 3.1), (2.0, 2.1), (-0.6, 3.0)), ((-1.1, 3.1), (-2.1, -2.0), (-0.6, 3.0))]
CRATES = [((2.0, 2.2), (y - 0.14, y + 0.14), (z - 0.14, z + 0.14)) for z in (0.75, 1.25) for y in (0.6, 0.2, -0.2, -0.6)]
STUDY = b"""recording: %s
methods:
  direct: {segmentation: {direct: {}}}
  erosion: {segmentation: {erosion: {radius_px: 1}}}
sweep:
  faults.misregistration.magnitude_m: [0, 0.03]
seeds: 2
"""


def write(path, data):
    with open(path, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode("utf-8"))


def in_yaml(name):
    """A double-quoted scalar that means these bytes."""
    plain = {0x22: b'\\"', 0x5C: b"\\\\"}
    return b'"' + b"".join(plain.get(byte) or (b"\\x%02x" % byte if byte < 0x20 or byte == 0x7F else bytes([byte]))
                           for byte in name) + b'"'


def in_xml(name):
    """A quoted attribute that means these bytes, but NUL, which XML cannot say and gets raw."""
    plain = {0x26: b"&amp;", 0x3C: b"&lt;", 0x3E: b"&gt;", 0x22: b"&quot;"}
    return b'"' + b"".join(plain.get(byte) or (b"&#%d;" % byte if 0 < byte < 0x20 else bytes([byte]))
                           for byte in name) + b'"'


def in_csv(name):
    return b'"' + name.replace(b'"', b'""') + b'"'


def cast(eye, rays, boxes):
    """Ray parameter and number of the nearest box for each ray; infinity and -1 without one."""
    nearest, number = np.full(rays.shape[:-1], np.inf), np.full(rays.shape[:-1], -1)
    with np.errstate(divide="ignore", invalid="ignore"):
        for n, ranges in enumerate(boxes):
            a, b = ((np.array([r[side] for r in ranges]) - eye) / rays for side in (0, 1))
            first, last = np.nanmax(np.minimum(a, b), axis=-1), np.nanmin(np.maximum(a, b), axis=-1)
            hit = (first <= last) & (first > 0) & (first < nearest)
            inside = (last > 0) & (first <= 0)
            assert not inside.any()
            nearest[hit], number[hit] = first[hit], n
    return nearest, number


def camera_view(x_m, boxes):
    v, u = np.indices(SIZE)
    rays = np.stack([np.ones(SIZE), -(u - 31.5) / FOCAL, -(v - 23.5) / FOCAL], axis=-1)
    return cast(np.array([x_m, 0, HEIGHT_M]), rays, boxes)


def write_images(folder, crates, shift_m):
    boxes = crates + ROOM
    for name in ("color", "depth", "label", "depth_label"):
        os.makedirs(os.path.join(folder, name))
    for n in range(FRAMES):
        depth, box = camera_view(0.1 * n + shift_m, boxes)
        instance = np.where((box >= 0) & (box < len(crates)), box + 1, 0).astype(np.uint16)
        colour = np.stack([instance * 25, 200 - instance * 20, np.full(SIZE, 90)], axis=-1).astype(np.uint8)
        for name, image in (("depth", np.rint(depth * 5000).astype(np.uint16)), ("label", instance),
                            ("depth_label", instance), ("color", colour)):
            Image.fromarray(image).save(os.path.join(folder, name, f"{n:06d}.png"))
    for name in ("color", "depth"):
        write(os.path.join(folder, f"{name}.txt"), "".join(f"{0.5 * n} {name}/{n:06d}.png\n" for n in range(FRAMES)))


def write_logs(folder, crates, shift_m):
    """Odometry and poses ten times, turns of the lidar five times a second; returns their counts."""
    stamps = [0.1 * n for n in range(16)]
    poses = "".join(f"{stamp:.6g} {0.2 * stamp + shift_m:.6g} 0 0 0 0 0 1\n" for stamp in stamps)
    write(os.path.join(folder, "groundtruth.txt"), poses)
    write(os.path.join(folder, "odometry.txt"),
          "".join(f"{stamp:.6g} {0.2 * stamp:.6g} 0 0 0 0 0 1\n" for stamp in stamps))
    beams, turns = 60, stamps[::2]
    angles = -np.pi + np.arange(beams) * 2 * np.pi / beams
    rays = np.stack([np.cos(angles), np.sin(angles), np.zeros(beams)], axis=-1)
    data = b"MSSCAN1\n" + struct.pack("<2I4d7d", beams, len(turns), -np.pi, 2 * np.pi / beams, 0.15, 12,
                                      0, 0, LIDAR_M, 0, 0, 0, 1)
    for stamp in turns:
        ranges, _ = cast(np.array([0.2 * stamp + shift_m, 0, LIDAR_M]), rays, crates + ROOM)
        data += struct.pack("<d", stamp) + ranges.astype("<f4").tobytes()
    os.makedirs(os.path.join(folder, "scan"))
    write(os.path.join(folder, "scan", "scans.bin"), data)
    return len(stamps), len(turns)


def recording_yaml(classes, instances, logs, scene=b"tiny.xml"):
    camera = "width_px: 64, height_px: 48, fx_px: 64, fy_px: 64, cx_px: 31.5, cy_px: 23.5, rate_hz: 2"
    counts = f"odometry_count: {logs[0]}\nscan_count: {logs[1]}\n"
    text = b"format_version: 1\nscene: " + in_yaml(scene) + f"""
scene_hash: "00000000000000000000000000000000"
mujoco_version: ""
seed: 1
frame_count: {FRAMES}
has_truth: true
{counts}color: {{{camera}}}
depth: {{{camera}, range_min_m: 0.6, range_max_m: 8}}
T_color_depth: [0, 0, 0, 0, 0, 0, 1]
T_base_depth: [0, 0, {HEIGHT_M}, {", ".join(map(str, OPTICAL_TO_BASE))}]
classes:
  - {{id: 0, name: background, colour: "808080", detect: false}}
""".encode()
    for n, name in enumerate(classes, 1):
        text += b'  - {id: %d, name: %s, colour: "%02XFF%02X", detect: true}\n' % (n, in_yaml(name), 25 * n, 9 * n)
    text += b"instances:\n  - {id: 0, name: background, class: 0}\n"
    for n, name in enumerate(instances, 1):
        text += b"  - {id: %d, name: %s, class: %d}\n" % (n, in_yaml(name), n)
    return text


def write_recording(folder, classes=(b"crate",), instances=None, geoms=None, scene=b"tiny.xml", shift_m=0.0):
    """instances, geoms: names, as many as classes; without them the classes' own. shift_m: of the whole drive along x."""
    instances = instances or [name + b"_1" for name in classes]
    crates = CRATES[:len(classes)]
    os.makedirs(os.path.join(folder, "truth") if isinstance(folder, str) else os.path.join(folder, b"truth"))
    folder = os.fsdecode(folder)
    write_images(folder, crates, shift_m)
    logs = write_logs(folder, crates, shift_m)
    write(os.path.join(folder, "recording.yaml"), recording_yaml(classes, instances, logs, scene))
    rows = b"kind,instance,name,px,py,pz,qx,qy,qz,qw,sx,sy,sz\n"
    names = list(geoms or [b"geom"] * len(crates)) + [b"wall"] * len(ROOM)
    for n, ranges in enumerate(crates + ROOM):
        number = n + 1 if n < len(crates) else 0
        centre, half = [(a + b) / 2 for a, b in ranges], [(b - a) / 2 for a, b in ranges]
        rows += b"box,%d,%s," % (number, in_csv(names[n])) + ",".join(map(repr, [*centre, 0, 0, 0, 1, *half])).encode() + b"\n"
    write(os.path.join(folder, "truth", "shapes.csv"), rows)


def write_foreign(folder, classes=(b"crate",)):
    """A TUM folder with label images and no recording.yaml; `classes.yaml` says what the labels mean."""
    os.makedirs(folder)
    write_images(folder, CRATES[:len(classes)], 0.0)
    write(os.path.join(folder, "groundtruth.txt"), "".join(f"{0.5 * n} {0.1 * n:.6g} 0 {HEIGHT_M} -0.5 0.5 -0.5 0.5\n"
                                                           for n in range(FRAMES)))
    write(os.path.join(folder, "classes.yaml"), b"classes:\n" + b"".join(
        b"  - {name: %s, label: %d}\n" % (in_yaml(name), n) for n, name in enumerate(classes, 1)))


ROBOT = """<mujoco model="robot"><worldbody><body name="base_footprint">
  <geom type="cylinder" pos="0 0 .5" size=".15 .5"/>
  <body name="camera_link" pos="0 0 1"><geom type="box" size=".02 .02 .02"/>
    <camera name="color" xyaxes="0 -1 0 0 0 1" fovy="45" resolution="64 48"/>
    <camera name="depth" pos="0 .025 0" xyaxes="0 -1 0 0 0 1" fovy="45" resolution="64 48"/>
  </body></body></worldbody></mujoco>
"""
SCENE_STUDY = b"""scene: %s
robot: robot.xml
trajectory: {waypoints_m_deg: [[0, 0, 0], [0.4, 0, 0]], speed_mps: 0.4, frames_per_s: %d}
cameras: {width_px: 64, height_px: 48}
methods: {direct: {segmentation: {direct: {}}}}
"""


def write_scene(folder, file=b"room.xml", classes=(b"crate",), bodies=None, geoms=None, meshes=None, frames_per_s=3):
    """room.xml, its class file, robot.xml and study.yaml. The last crate is a mesh."""
    bodies = bodies or [b"crate_%d" % n for n in range(1, len(classes) + 1)]
    geoms = geoms or [b"geom_%d" % n for n in range(1, len(classes) + 1)]
    mesh = (meshes or [b"wedge"])[0]
    text = b'<mujoco model="room"><asset><mesh name=' + in_xml(mesh) + \
        b' vertex="0 0 0 .3 0 0 0 .3 0 .3 .3 0 0 0 .3 0 .3 .3"/></asset><worldbody>\n' \
        b'<geom type="plane" size="5 5 .1"/><geom type="box" pos="3 0 1" size=".05 2 1"/>\n'
    for n, (body, geom) in enumerate(zip(bodies, geoms)):
        shape = b'type="mesh" mesh=' + in_xml(mesh) if n == len(bodies) - 1 else b'type="box" size=".1 .14 .14"'
        x, y, z = (sum(r) / 2 for r in CRATES[n])
        text += b"<body name=%s pos=\"%.3f %.3f %.3f\"><geom name=%s %s/></body>\n" % (in_xml(body), x, y, z, in_xml(geom), shape)
    write(os.path.join(os.fsencode(folder), file), text + b"</worldbody></mujoco>\n")
    stem = file[:-4]
    write(os.path.join(os.fsencode(folder), stem + b".classes.yaml"), b"classes:\n" + b"".join(
        b"  - {name: %s, bodies: [%s]}\n" % (in_yaml(name), in_yaml(as_pattern(body))) for name, body in zip(classes, bodies)))
    write(os.path.join(folder, "robot.xml"), ROBOT)
    write(os.path.join(folder, "study.yaml"), SCENE_STUDY % (in_yaml(file), frames_per_s))


def as_pattern(name):
    """A shell pattern that matches this name alone."""
    return b"".join(b"\\" + bytes([byte]) if byte in b"*?[]\\" else bytes([byte]) for byte in name)
