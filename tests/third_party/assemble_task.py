# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes the scene of a task as one MJCF, things standing where its package puts them: assemble_task.py TASK FILE.xml"""

import os
import sys

import mujoco
import numpy as np

PACKAGES = os.path.dirname(os.path.dirname(mujoco.__file__))
FETCH_CUBE_M = [1.32, 0.78, 0.425]  # on its table; its environment draws a place there
TABLE_TOP_M = 0.8
TABLE_SPACING_M, TABLE_SCATTER_M = 0.2, 0.04
TABLE_OBJECTS = ["bottle", "can", "milk", "bread", "cereal", "lemon", "square-nut", "round-nut", "plate-with-hole"]
ROBOSUITE = {"robosuite_stack": "Stack", "robosuite_nuts": "NutAssembly", "robosuite_bins": "PickPlace",
             "robosuite_door": "Door"}


def loaded(file):
    """A specification whose files have absolute paths, so that it can be written elsewhere."""
    spec = mujoco.MjSpec.from_file(file)
    folder = os.path.dirname(file)

    def absolute(name, kind):
        return os.path.normpath(os.path.join(folder, kind or "", name)) if name else name

    for mesh in spec.meshes:
        mesh.file = absolute(mesh.file, spec.meshdir)
    for texture in spec.textures:
        texture.file = absolute(texture.file, spec.texturedir)
        texture.cubefiles = [absolute(name, spec.texturedir) for name in texture.cubefiles]
    spec.meshdir = spec.texturedir = ""
    return spec


def stand(spec, model, data):
    """Bodies with a free joint where the environment put them."""
    for index in range(model.nbody):
        joint = model.body_jntadr[index]
        if model.body_jntnum[index] != 1 or model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
            continue
        pose = data.qpos[model.jnt_qposadr[joint]:][:7]
        body = spec.body(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, index))
        body.pos, body.quat = pose[:3], pose[3:]


def robosuite_task(name):
    import robosuite

    env = robosuite.make(name, robots="Panda", has_renderer=False, has_offscreen_renderer=False, use_camera_obs=False,
                         seed=7)
    env.reset()
    spec = mujoco.MjSpec.from_string(env.sim.model.get_xml())
    stand(spec, env.sim.model._model, env.sim.data._data)
    return spec


def lowest_m(model):
    """Of a model's meshes and upright boxes."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    heights = []
    for geom in range(model.ngeom):
        low = data.geom_xpos[geom][2] - model.geom_size[geom][2]
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = model.geom_dataid[geom]
            vertices = model.mesh_vert[model.mesh_vertadr[mesh]:][:model.mesh_vertnum[mesh]]
            low = (vertices @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])[:, 2].min()
        heights.append(low)
    return min(heights)


def table():
    """Nine of robosuite's objects on its table, three by three."""
    assets = os.path.join(PACKAGES, "robosuite", "models", "assets")
    spec = loaded(os.path.join(assets, "arenas", "table_arena.xml"))
    random = np.random.default_rng(11)
    for index, name in enumerate(TABLE_OBJECTS):
        source = loaded(os.path.join(assets, "objects", f"{name}.xml"))
        low = lowest_m(source.compile())
        x, y = ((place - 1) * TABLE_SPACING_M + random.uniform(-TABLE_SCATTER_M, TABLE_SCATTER_M)
                for place in (index % 3, index // 3))
        body = source.worldbody.first_body()
        body.name = name.replace("-", "_")
        spec.worldbody.add_frame(pos=[x, y, TABLE_TOP_M - low]).attach_body(body, f"{body.name}_", "")
    return spec


def fetch():
    spec = loaded(os.path.join(PACKAGES, "gymnasium_robotics/envs/assets/fetch/pick_and_place.xml"))
    spec.body("object0").pos = FETCH_CUBE_M
    return spec


def ogbench(folder):
    from dm_control import mjcf
    from ogbench.manipspace.envs.scene_env import SceneEnv

    env = SceneEnv(env_type="scene", mode="data_collection")
    env.reset(seed=3)
    raw = os.path.join(folder, "assets")
    mjcf.export_with_assets(env.mjcf_model, raw, "scene.xml")
    spec = loaded(os.path.join(raw, "scene.xml"))
    stand(spec, env.model, env.data)
    return spec


def main(task, file):
    folder = os.path.dirname(os.path.abspath(file))
    os.makedirs(folder, exist_ok=True)
    if task in ROBOSUITE:
        spec = robosuite_task(ROBOSUITE[task])
    else:
        spec = {"robosuite_table": table, "fetch": fetch, "ogbench_ur5e": lambda: ogbench(folder)}[task]()
    spec.compile()
    with open(file, "w", encoding="utf-8") as text:
        text.write(spec.to_xml())


if __name__ == "__main__":
    main(*sys.argv[1:])
