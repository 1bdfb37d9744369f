#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Holds the maps that `mapscore run` writes against the independent ruler's, voxel by voxel, on a drive through corner.xml.

fused_maps.py PROGRAM SCENES draws|rules|verdicts    draws: in how many draws from a pose belief each class won each voxel;
    rules: the class probabilities of every fusion rule; verdicts: wrong classes and scores of detections, as the most
    confident one in a voxel. Under faults of pose, depth and labels. Counts are equal, probabilities within 1e-12, log-odds,
    which are of single precision, within 1e-5
"""

import glob
import os
import sys
import tempfile

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # many small systems, which threads only slow down

import numpy as np
import yaml

sys.dont_write_bytecode = True

import ruler
from drives import corner_scene, program, record
from free_space import in_view
from fusion import RULES, FusedMap, hits_of
from octree_files import SemanticTree
from poses import believed_poses, covariance, drawn_poses
from recording import Recording, map_from_world, moved
from segmentation import observe
from sights import faulty_sight
from streams import trial_seed
from truth import unpack, voxels_of

# More depth images than colour images: their numbers, which name streams, differ.
TRAJECTORY = {"waypoints_m_deg": [[0.213, 0.317, 37], [0.157, 1.013, 11], [0.423, 1.437, 3]], "frames_per_s": 1.7,
              "depth_frames_per_s": 5.1}
STUDY = {"seed": 11, "voxel_m": 0.05, "map_origin_m": [0.0131, 0.0217, 0.0343], "map_yaw_deg": 7.3, "place": "points",
         "detect": ["crate", "ball", "rock"], "methods": {"one": {"segmentation": {"direct": {}}}}}
SIX = ["crate", "ball", "rock", "table", "post", "floor"]  # more than top3 keeps
EVEN = {"sigma_xy_m": 0.02, "sigma_z_m": 0.007, "sigma_roll_pitch_deg": 0.4, "sigma_yaw_deg": 1.1}
# Lower triangular root of a covariance. y follows x, and roll is exact: two pivots are zero. z nearly follows x.
ROOT = np.array([[0.02, 0, 0, 0, 0, 0], [0.01, 0, 0, 0, 0, 0], [0.009, 0, 0.004, 0, 0, 0], [0] * 6,
                 [0.001, 0, 0.0005, 0, 0.006, 0], [-0.003, 0, 0.0001, 0, 0.0002, 0.0155]])
TIED = {"covariance_m_rad": (ROOT @ ROOT.T).tolist()}
CAMERA = {"preset": "astra", "lateral": 0.5, "axial": 0.5}
NETWORK = {"preset": "typical", "confusion": 0.35, "boundary_px": 1.3}
LOST = {"confusion_matrix": [[0.6, 0.3, 0.1], [0, 0.7, 0.3], [0.4, 0.1, 0.5]], "scores": 0.8, "score_mean": 0.75}
SURE = {"confusion": 0.6, "scores": 1, "score_mean": 0.2}

# name -> keys of a study
CASES = {
    "draws": {
        "axes by themselves, about the robot": {"fusion": {"vote": {"N": 10}}, "faults": {"pose": EVEN}},
        "full covariance, about the robot": {
            "fusion": {"vote": {"N": 10, "covariance": "full"}},
            "faults": {"pose": {**TIED, "reported_scale": 1.7, "sigma_scale": 0.8}}},
        "diagonal of a full covariance, a random walk, noisy depth": {
            "fusion": {"vote": {"N": 10}}, "faults": {"pose": {**TIED, "kind": "walk"}, "depth": CAMERA}},
        "full covariance, about odom, a constant error, noisy labels": {
            "fusion": {"vote": {"N": 10, "covariance": "full", "noise_at": "odom"}},
            "faults": {"pose": {**TIED, "kind": "constant"}, "labels": NETWORK}},
        "two draws, region growing, places of voxels": {
            "fusion": {"vote": {"N": 2}}, "faults": {"pose": EVEN}, "place": "voxels",
            "methods": {"one": {"segmentation": {"region_growing": {}}}}}},
    "rules": {
        "blend": {"fusion": {"blend": {"N": 10, "K": 0.6}}, "faults": {"pose": EVEN, "labels": NETWORK}},
        "blend, decay in view, noisy depth": {
            "fusion": {"blend": {"N": 3, "K": 0.02, "decay": "view"}},
            "faults": {"pose": EVEN, "labels": NETWORK, "depth": CAMERA}},
        "max_confidence": {"fusion": {"max_confidence": {"N": 10}}, "faults": {"pose": EVEN, "labels": NETWORK}},
        "vote": {"fusion": {"vote": {"N": 3}}, "faults": {"pose": EVEN, "labels": LOST}},
        "bayes": {"fusion": {"bayes": {"N": 10}}, "faults": {"pose": EVEN, "labels": LOST}},
        "bayes, priors and doubt": {
            "fusion": {"bayes": {"N": 3, "doubt": 0.21, "priors": [0.23, 0.11, 0.31]}},
            "faults": {"pose": EVEN, "labels": SURE}},
        "top3": {"fusion": {"top3": {"N": 10}}, "faults": {"pose": EVEN, "labels": SURE}, "detect": SIX},
        "top3, lambda and doubt": {
            "fusion": {"top3": {"N": 3, "lambda": 0.7, "doubt": 0.13}}, "faults": {"pose": EVEN, "labels": SURE},
            "detect": SIX}}}

CASES["verdicts"] = {name: {"fusion": {"max_confidence": {}}, "faults": {"labels": labels}} for name, labels in {
    "wrong classes, all alike": {"confusion": 0.6},
    "wrong classes by a matrix": {"confusion_matrix": [[0.5, 0.2, 0.3], [0.3, 0.7, 0], [0, 0.6, 0.4]], "scale": 1.4},
    "calibrated scores": {"confusion": 0.4, "scores": 1},
    "scores too high": {"confusion": 0.4, "scores": 0.7, "score_mean": 0.9, "score_concentration": 3},
    "scores too low": {"confusion": 0.4, "scores": 1, "score_mean": 0.15, "score_concentration": 1.7},
    "scores of a network that never believes itself": {"scores": 0.8, "score_mean": 0}}.items()}


def written_map(mapscore, name, study, folder):
    """key -> (log-odds, {class: weight}) of the program's map."""
    file, results = os.path.join(folder, f"{name}.yaml"), os.path.join(folder, name)
    with open(file, "w", encoding="utf-8") as text:
        yaml.safe_dump(study, text)
    program(mapscore, "run", file, "-o", results, "-q")
    path, = glob.glob(os.path.join(results, "runs", "one-seed0-*", "map.ot"))
    return SemanticTree(path).voxels


def rule_of(fusion, recording):
    (name, keys), = fusion.items()
    own = {key: value for key, value in keys.items() if key not in ("noise_at", "covariance", "decay")}
    if name == "bayes":
        own["detected"] = recording.detected
    return RULES[name](len(recording.names), **own), keys


def observed(recording, study, seed):
    """Points in depth_optical, their classes and scores, and the depth image, of each frame."""
    (method, of_method), = study["methods"]["one"]["segmentation"].items()
    options = ruler.parse([recording.folder, "--method", method, "--place", study["place"]])[1]
    vars(options).update(of_method)
    for number in range(len(recording.frames)):
        sight = faulty_sight(recording, number, study["faults"], seed)
        yield *observe(recording, sight, options, recording.T_color_depth)[:3], sight.z


def expected_map(recording, study):
    recording.detected = {label for label, name in recording.names.items() if name in study["detect"]}
    seed, edge, pose_keys = trial_seed(study["seed"]), study["voxel_m"], study["faults"].get("pose", {})
    rule, keys = rule_of(study["fusion"], recording)
    T_map_world, fused = map_from_world(study["map_origin_m"], np.radians(study["map_yaw_deg"])), FusedMap(rule)
    believed = believed_poses([T_map_world @ frame[3] for frame in recording.frames], pose_keys, seed)
    E = pose_keys.get("reported_scale", 1) * covariance(pose_keys)
    for number, (points, classes, scores, z) in enumerate(observed(recording, study, seed)):
        pose = believed[number]
        places = [moved(drawn @ recording.T_base_depth, points) for drawn in drawn_poses(pose, E, keys, seed, number)]
        hit, d, S = hits_of([(voxels_of(place, edge), classes, scores) for place in places], rule.class_count)
        if keys.get("decay") == "view":
            others = fused.keys[~np.isin(fused.keys, hit)]
            fused.fade(others[in_view(recording, pose @ recording.T_base_depth, z, edge, unpack(others), behind=edge)])
        fused.add(hit, d, S)
    return fused.contents()


def voxel_differences(name, ours, theirs):
    lines = []
    for key in sorted(set(ours) | set(theirs)):
        (odds, told), (log_odds, expected) = (one.get(key, (np.inf, {})) for one in (ours, theirs))
        same = abs(odds - log_odds) <= 1e-5 and set(told) == set(expected) and all(
            abs(told[label] - weight) <= 1e-12 * max(1, weight) for label, weight in expected.items())
        if not same:
            voxel = ",".join(map(str, unpack(np.int64(key)).tolist()))
            lines.append(f"  {name}: voxel {voxel}: program {odds:.6g} {told}, ruler {log_odds:.6g} {expected}")
    return lines


def main(mapscore, scenes, what):
    mapscore, failed = os.path.abspath(mapscore), False
    with tempfile.TemporaryDirectory() as folder:
        recording = record(mapscore, corner_scene(scenes, folder), TRAJECTORY, folder)
        for name, keys in CASES[what].items():
            study = {**STUDY, **keys, "recording": recording}
            ours, theirs = written_map(mapscore, name, study, folder), expected_map(Recording(recording), study)
            lines = voxel_differences(name, ours, theirs)
            print(f"{name}: {len(theirs)} voxels compared, {len(lines)} differ", flush=True)
            print("\n".join(lines[:20]), end="\n" if lines else "")
            failed |= bool(lines) or not theirs
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
