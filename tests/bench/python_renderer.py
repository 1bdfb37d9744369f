# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""The images of a recording, drawn by MuJoCo's own Python Renderer on OSMesa. Used by compare_renderer.py.

    python_renderer.py poses SCENE ROBOT           base poses "x y yaw_deg" a line in, TUM lines of the colour camera out
    python_renderer.py draw SCENE ROBOT RECORDING FOLDER WORKER WORKERS
        waits for lines "LEVEL SHADOWS" and draws and writes its share of the recording's frames for each, then says
        `done` and the processor's seconds; level -1 is OpenCV's own
    python_renderer.py compare RECORDING FOLDER    shares of pixels that are the same, a line a kind of image

As fast as the Renderer allows: one for all, its scene updated once a camera, arrays reused, each image drawn once. As
alike as it can be: the robot is attached as mapscore attaches it and not drawn, nor is what is transparent; the same
clip planes, size of shadow maps and flags.
"""

import os
import sys
import time

os.environ["MUJOCO_GL"] = "osmesa"

import cv2
import mujoco
import numpy as np

CLIP_M = (0.1, 100.0)
SHADOW_MAP_PX = 1024
DEPTH_UNITS_PER_M = 5000
CHANNELS = ("color", "label", "depth", "depth_label")


class Scene:
    """A scene with the robot attached, at poses of its base."""

    def __init__(self, scene, robot):
        spec = mujoco.MjSpec.from_file(scene)
        guest = mujoco.MjSpec.from_file(robot)
        spec.compiler.fusestatic = guest.compiler.fusestatic = False
        spec.worldbody.add_frame().attach_body(guest.body("base_footprint"), "robot/", "")
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.base = self.model.body("robot/base_footprint").id
        visual = self.model.vis
        visual.map.znear, visual.map.zfar = np.array(CLIP_M) / self.model.stat.extent
        visual.quality.offsamples = 0
        visual.quality.shadowsize = min(visual.quality.shadowsize, SHADOW_MAP_PX)
        visual.global_.offwidth = max(visual.global_.offwidth, 640)
        visual.global_.offheight = max(visual.global_.offheight, 480)
        self.hide()

    def hide(self):
        """Geoms that mapscore leaves out go into a group that is not drawn."""
        model = self.model
        for geom in range(model.ngeom):
            material = model.geom_matid[geom]
            plain = np.array_equal(model.geom_rgba[geom], np.float32([0.5, 0.5, 0.5, 1]))
            alpha = model.mat_rgba[material, 3] if material >= 0 and plain else model.geom_rgba[geom, 3]
            if alpha < 1 or self.name_of(model.geom_bodyid[geom]).startswith("robot/"):
                model.geom_group[geom] = 5

    def name_of(self, body):
        return self.model.body(body).name

    def stand(self, position, quaternion_xyzw):
        self.model.body_pos[self.base] = position
        self.model.body_quat[self.base] = np.roll(quaternion_xyzw, 1)
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)

    def instances(self, names):
        """Instance id of each geom, and 0 at the end: the table for segmentation's -1."""
        ids = {name: number for number, name in enumerate(names) if number > 0}
        table = np.zeros(self.model.ngeom + 1, np.uint16)
        for geom in range(self.model.ngeom):
            body = self.model.geom_bodyid[geom]
            while body > 0 and self.name_of(body) not in ids:
                body = self.model.body_parentid[body]
            table[geom] = ids.get(self.name_of(body), 0)
        return table


class Painter:
    def __init__(self, scene, info):
        self.scene, self.range_units = scene, info["range_units"]
        self.renderer = mujoco.Renderer(scene.model, info["height"], info["width"])
        self.table = scene.instances(info["instances"])
        size = (info["height"], info["width"])
        self.rgb, self.metres = np.empty((*size, 3), np.uint8), np.empty(size, np.float32)
        self.ids = np.empty((*size, 2), np.int32)

    def draw(self, shadows):
        """The four images at the pose where the scene's robot stands."""
        renderer, flags = self.renderer, self.renderer.scene.flags
        renderer.update_scene(self.scene.data, "robot/color")
        flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = flags[mujoco.mjtRndFlag.mjRND_HAZE] = 0
        flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        renderer.disable_segmentation_rendering()
        color = cv2.cvtColor(renderer.render(out=self.rgb), cv2.COLOR_RGB2BGR)
        label = self.draw_labels()
        renderer.update_scene(self.scene.data, "robot/depth")
        depth_label = self.draw_labels()
        renderer.enable_depth_rendering()
        units = renderer.render(out=self.metres)
        renderer.disable_depth_rendering()
        units *= DEPTH_UNITS_PER_M
        np.rint(units, out=units)
        units[(units < self.range_units[0]) | (units > self.range_units[1])] = 0
        depth = units.astype(np.uint16)
        depth_label[depth == 0] = 0
        return color, label, depth, depth_label

    def draw_labels(self):
        self.renderer.enable_segmentation_rendering()
        objects = self.renderer.render(out=self.ids)
        self.renderer.disable_segmentation_rendering()
        return self.table[objects[:, :, 0]]


def read_info(recording):
    """What is needed of recording.yaml; one key a line, so that no YAML reader is."""
    info = {"instances": []}
    listed = None
    with open(os.path.join(recording, "recording.yaml"), encoding="utf-8") as text:
        for line in text:
            if not line.startswith(" "):
                listed = line.split(":")[0]
            elif listed == "instances":
                info["instances"].append(line.split('name: "')[1].split('"')[0])
            if listed == "depth":
                pairs = dict(part.strip(" {}\n").split(": ") for part in line.split(": ", 1)[1].split(","))
                info["width"], info["height"] = int(pairs["width_px"]), int(pairs["height_px"])
                limits = float(pairs["range_min_m"]), float(pairs["range_max_m"])
                info["range_units"] = [round(limit * DEPTH_UNITS_PER_M) for limit in limits]
    return info


def write_poses(scene):
    for number, line in enumerate(sys.stdin):
        x, y, yaw_deg = (float(word) for word in line.split())
        half = np.radians(yaw_deg) / 2
        scene.stand([x, y, 0], [0, 0, np.sin(half), np.cos(half)])
        camera = scene.data.camera("robot/color")
        rotation = camera.xmat.reshape(3, 3) @ np.diag([1.0, -1.0, -1.0])  # to optical axes
        w, *xyz = (float(value) for value in quaternion_of(rotation))
        print(number / 10, *(repr(float(value)) for value in camera.xpos), *map(repr, xyz), repr(w))


def quaternion_of(rotation):
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, rotation.ravel())
    return quaternion


def draw(scene, recording, folder, worker, workers):
    painter = Painter(scene, read_info(recording))
    poses = np.loadtxt(os.path.join(recording, "groundtruth.txt"), ndmin=2)[:, 1:]
    mine = range(worker, len(poses), workers)
    for channel in CHANNELS:
        os.makedirs(os.path.join(folder, channel), exist_ok=True)
    for shadows in (0, 1):  # warms up
        scene.stand(poses[0, :3], poses[0, 3:])
        painter.draw(shadows)
    print("ready", flush=True)
    for order in sys.stdin:
        level, shadows = (int(word) for word in order.split())
        started = time.process_time()
        options = [] if level < 0 else [cv2.IMWRITE_PNG_COMPRESSION, level]
        for frame in mine:
            scene.stand(poses[frame, :3], poses[frame, 3:])
            for channel, image in zip(CHANNELS, painter.draw(shadows)):
                cv2.imwrite(os.path.join(folder, channel, f"{frame:06}.png"), image, options)
        print("done", time.process_time() - started, flush=True)
    painter.renderer.close()


def compare(recording, folder):
    frames = len(os.listdir(os.path.join(recording, "color")))
    for channel, most in zip(CHANNELS, (2, 0, 1, 0)):
        same = pixels = bytes_ours = bytes_theirs = 0
        for frame in range(frames):
            names = [os.path.join(of, channel, f"{frame:06}.png") for of in (recording, folder)]
            ours, theirs = (cv2.imread(name, cv2.IMREAD_UNCHANGED).astype(int) for name in names)
            near = np.abs(ours - theirs) <= most
            near = near.all(axis=2) if near.ndim == 3 else near
            same, pixels = same + int(near.sum()), pixels + near.size
            bytes_ours += os.path.getsize(names[0])
            bytes_theirs += os.path.getsize(names[1])
        print(channel, most, same / pixels, bytes_ours / frames, bytes_theirs / frames)


def main(verb, *arguments):
    if verb == "compare":
        return compare(*arguments)
    scene = Scene(*arguments[:2])
    if verb == "poses":
        return write_poses(scene)
    return draw(scene, *arguments[2:4], int(arguments[4]), int(arguments[5]))


if __name__ == "__main__":
    main(*sys.argv[1:])
