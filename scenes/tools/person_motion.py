#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes the motion of scenes/moving_person.xml: a person who shifts weight, gestures and steps to
the side for 715 frames at 30 frames/s.

    python3 scenes/tools/person_motion.py scenes/moving_person.motion.csv

The feet are planted or on an arc, the pelvis glides between them, and the legs follow by inverse
kinematics in the plane of each leg, soles level. Radians and metres; y > 0 is the person's right.
"""
import math
import sys

RATE_HZ, FRAMES = 30, 715

# Anchors of the joints in the person's frame at rest, as in moving_person.xml (right side).
HIP, KNEE, ANKLE = (0.095, 0.88), (0.105, 0.475), (0.112, 0.09)  # y, z
UPPER = math.dist(HIP, KNEE)
LOWER = math.dist(KNEE, ANKLE)
LEAST_BEND = 0.997  # of the leg's full length: a standing leg is never quite straight
LIFT_M = 0.055

# Start, length in metres (towards +y) and duration of each step to the side.
STEPS = [(1.6, 0.34, 0.95), (2.7, 0.31, 0.90), (6.4, -0.36, 0.95), (7.5, -0.37, 1.00), (8.7, -0.29, 0.85),
         (12.1, 0.38, 0.95), (13.2, -0.33, 0.90), (16.3, -0.22, 0.80), (17.3, 0.36, 0.90), (18.4, 0.35, 0.95),
         (21.6, -0.33, 0.95)]
START_Y_M = -0.06

# From, until, and what an arm does meanwhile: (side, abduct, flex, twist, elbow, wave amplitude, wave Hz).
GESTURES = [(3.9, 6.9, ("right", 1.05, 0.35, 0.0, 1.55, 0.55, 1.05)),
            (4.6, 6.6, ("left", 0.25, 0.30, 0.0, 1.05, 0.12, 0.70)),
            (9.3, 11.9, ("right", 0.75, 0.65, 0.3, 0.75, 0.35, 0.85)),
            (9.5, 12.1, ("left", 0.75, 0.65, -0.3, 0.75, 0.35, 0.85)),
            (14.0, 16.4, ("left", 0.20, 1.35, 0.0, 0.35, 0.25, 0.95)),
            (16.9, 19.6, ("right", 0.35, 0.95, 0.0, 1.25, 0.45, 1.15)),
            (19.3, 22.9, ("left", 1.15, 0.25, 0.0, 1.45, 0.60, 0.95))]
RAISE_S = 0.65

JOINTS = ["root_x", "root_y", "root_z", "root_yaw", "waist_yaw", "waist_bend", "waist_lean", "neck_yaw", "neck_nod"]
for side in ("right", "left"):
    JOINTS += [f"{side}_{j}" for j in ("shoulder_abduct", "shoulder_flex", "shoulder_twist", "elbow", "hip_roll",
                                       "hip_pitch", "knee", "ankle_pitch", "ankle_roll")]


def ease(share):
    """0 to 1 with speed and acceleration 0 at both ends."""
    share = min(max(share, 0.0), 1.0)
    return share ** 3 * (10 - 15 * share + 6 * share ** 2)


def glide(t, first, second, offset):
    """What a thing has gone by time t when it moves from share `first` to `second` of every step."""
    return offset + sum(length * ease((t - start - first * time) / ((second - first) * time))
                        for start, length, time in STEPS)


def lift(t, leads):
    """Height of the right foot (or the left) on its arc: the foot on the step's side goes first."""
    height = 0.0
    for start, length, time in STEPS:
        first = (length > 0) == leads
        share = (t - start) / time - (0.0 if first else 0.5)
        if 0 < share < 0.5:
            height = LIFT_M * math.sin(2 * math.pi * share) ** 2
    return height


def foot_y(t, right):
    """Lateral place of a foot, its rest offset left out."""
    y = START_Y_M
    for start, length, time in STEPS:
        first = (length > 0) == right
        begin = start + (0.0 if first else 0.5 * time)
        y += length * ease((t - begin) / (0.5 * time))
    return y


def leg(side, pelvis_y, pelvis_z, foot, height):
    """Angles of one leg so that its ankle is over the foot, in the leg's plane."""
    dy = side * (ANKLE[0] - HIP[0]) + foot - pelvis_y
    dz = ANKLE[1] + height - HIP[1] - pelvis_z
    rest = math.atan2(side * (ANKLE[0] - HIP[0]), HIP[1] - ANKLE[1])
    roll = math.atan2(dy, -dz) - rest
    length = min(math.hypot(dy, dz), UPPER + LOWER)
    knee = math.pi - math.acos(max(-1.0, (UPPER ** 2 + LOWER ** 2 - length ** 2) / (2 * UPPER * LOWER)))
    pitch = math.acos(min(1.0, (UPPER ** 2 + length ** 2 - LOWER ** 2) / (2 * UPPER * length)))
    return {"hip_roll": side * roll, "hip_pitch": pitch, "knee": knee, "ankle_pitch": knee - pitch,
            "ankle_roll": -side * roll}


def pelvis_height(pelvis_y, feet):
    """As high as the leg that reaches farthest lets it."""
    full = LEAST_BEND * (UPPER + LOWER)
    heights = []
    for side, (foot, height) in feet.items():
        dy = side * (ANKLE[0] - HIP[0]) + foot - pelvis_y
        heights.append(ANKLE[1] + height + math.sqrt(full ** 2 - dy ** 2) - HIP[1])
    return min(heights)


def arm(t, side):
    phase = 0.0 if side == "right" else math.pi
    pose = [0.10, 0.13 * math.sin(2 * math.pi * 0.45 * t + phase), 0.0, 0.22 + 0.06 * math.sin(2 * math.pi * 0.45 * t)]
    for begin, end, (of, abduct, flex, twist, elbow, wave, hz) in GESTURES:
        if of != side:
            continue
        share = ease((t - begin) / RAISE_S) * ease((end - t) / RAISE_S)
        swing = wave * math.sin(2 * math.pi * hz * (t - begin))
        wanted = [abduct + 0.25 * swing, flex + 0.15 * swing, twist + 0.5 * swing, elbow + swing]
        pose = [p + share * (w - p) for p, w in zip(pose, wanted)]
    return dict(zip(("shoulder_abduct", "shoulder_flex", "shoulder_twist", "elbow"), pose))


def configuration(t):
    sway = 0.05 * math.sin(2 * math.pi * 0.34 * t) + 0.012 * math.sin(2 * math.pi * 0.83 * t + 1)
    y = glide(t, 0.05, 0.95, START_Y_M) + sway
    feet = {1: (foot_y(t, True), lift(t, True)), -1: (foot_y(t, False), lift(t, False))}
    z = pelvis_height(y, feet)
    q = {"root_x": 0.0, "root_y": y, "root_z": z, "root_yaw": 0.0,
         "waist_yaw": 0.16 * math.sin(2 * math.pi * 0.27 * t + 0.7),
         "waist_bend": 0.04 + 0.05 * math.sin(2 * math.pi * 0.19 * t),
         "waist_lean": 0.9 * sway + 0.03 * math.sin(2 * math.pi * 0.4 * t),
         "neck_yaw": 0.35 * math.sin(2 * math.pi * 0.23 * t + 2), "neck_nod": 0.08 * math.sin(2 * math.pi * 0.5 * t)}
    for name, side in (("right", 1), ("left", -1)):
        q |= {f"{name}_{joint}": angle for joint, angle in arm(t, name).items()}
        q |= {f"{name}_{joint}": angle for joint, angle in leg(side, y, z, *feet[side]).items()}
    return q


def main():
    with open(sys.argv[1], "w", encoding="ascii") as out:
        out.write("# Motion of moving_person.xml, written by scenes/tools/person_motion.py; radians and metres.\n")
        out.write("stamp_s," + ",".join(JOINTS) + "\n")
        for frame in range(FRAMES):
            t = frame / RATE_HZ
            q = configuration(t)
            out.write(f"{t:.6f}," + ",".join(f"{q[joint]:.4f}" for joint in JOINTS) + "\n")


if __name__ == "__main__":
    main()
