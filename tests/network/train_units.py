# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Cases worked by hand for scripts/train: folding, registered depth, weights, scores, intervals, places.

    tests/network/train_units.py          # exit 1 with the case that fails
"""

import math
import pathlib
import sys
import unittest
import xml.etree.ElementTree as xml

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/train"))

import data  # noqa: E402
import evaluate  # noqa: E402
import export  # noqa: E402
import fit  # noqa: E402
import nets  # noqa: E402
import scenes  # noqa: E402
import torch  # noqa: E402


class Folding(unittest.TestCase):
    def test_each_class_of_the_scenes_has_one_channel_at_most(self):
        for name, fold in data.class_lists().items():
            members = [m for of in fold.values() for m in of]
            self.assertEqual(len(members), len(set(members)), name)

    def test_nyu13_leaves_no_class_of_the_home_out(self):
        members = {m for of in data.class_lists()["nyu13"].values() for m in of}
        home = data.yaml.safe_load((ROOT / "scenes/home.classes.yaml").read_text())
        self.assertEqual(members, {c["name"] for c in home["classes"]})

    def test_channels_follow_the_list(self):
        label = np.array([[0, 1], [2, 3]])
        folded = data.folded(label, ["background", "rug", "cup", "floor"], {"floor": ["floor", "rug"], "tv": ["tv"]})
        self.assertEqual(folded.tolist(), [[0, 1], [0, 1]])


class Registration(unittest.TestCase):
    def setUp(self):
        camera = {"width_px": 640, "fx_px": 500, "fy_px": 500, "cx_px": 319.5, "cy_px": 239.5}
        self.depth, self.color = data.Camera(camera), data.Camera(camera, data.WIDTH)

    def test_a_camera_in_the_same_place_sees_the_same(self):
        image = data.registered(np.full((480, 640), 10000, np.uint16), self.depth, self.color, [0, 0, 0, 0, 0, 0, 1])
        self.assertTrue((image == 10000).all())

    def test_a_point_moves_by_the_baseline_and_the_nearest_stays(self):
        depth = np.zeros((480, 640), np.uint16)
        depth[240, 320] = 10000   # 2 m: 25 mm are 500 / 2 * 0.025 / 2 = 3.1 pixels of the small image
        image = data.registered(depth, self.depth, self.color, [-0.025, 0, 0, 0, 0, 0, 1])
        v, u = (int(n[0]) for n in np.nonzero(image))
        self.assertEqual((v, u), (120, 157))
        depth[241, 321] = 5000    # 1 m lands elsewhere; beside the first at the same pixel the nearer stays
        depth[240, 320], depth[241, 320] = 10000, 9000
        image = data.registered(depth, self.depth, self.color, [0, 0, 0, 0, 0, 0, 1])
        self.assertEqual(image[120, 160], 5000)


class Weights(unittest.TestCase):
    def test_median_frequency(self):
        label = np.zeros((2, 2, 4), np.uint8)
        label[0] = 1                       # class 1: 8 of 8 pixels in its one frame
        label[1, 0], label[1, 1] = 2, 3    # classes 2 and 3: 4 of 8
        label[1, 1, 3] = 4                 # class 4: 1 of 8, class 3 then 3 of 8
        weights = data.class_weights(label, 6, most=3)
        median = (0.5 + 0.375) / 2
        np.testing.assert_allclose(weights, [0, median, median / 0.5, median / 0.375, 3, 0], rtol=1e-6)

    def test_poly_rate(self):
        recipe = fit.Recipe(steps=100, learning_rate=0.05, warm_up=1)
        self.assertAlmostEqual(fit.rate(recipe, 50), 0.05 * 0.5**0.9)


class Scores(unittest.TestCase):
    def test_counts_by_hand(self):
        counts = np.array([[0, 0, 0, 0], [0, 6, 2, 0], [0, 1, 3, 0], [0, 0, 0, 0]])
        scores = evaluate.scores(counts, ["background", "a", "b", "absent"])
        self.assertAlmostEqual(scores.mpa, (6 / 8 + 3 / 4) / 2)
        self.assertAlmostEqual(scores.miou, (6 / 9 + 3 / 6) / 2)
        self.assertAlmostEqual(scores.pixel_accuracy, 9 / 12)
        self.assertNotIn("absent", scores.iou)

    def test_interval_of_three(self):
        mean, half = evaluate.interval([1.0, 2.0, 3.0])
        self.assertAlmostEqual(mean, 2)
        self.assertAlmostEqual(half, 4.302653 / math.sqrt(3), places=5)   # Student's t of 2 degrees, 97.5 %
        self.assertTrue(math.isinf(evaluate.interval([1.0])[1]))


class Folded(unittest.TestCase):
    def test_folding_batch_normalisation_changes_nothing(self):
        torch.manual_seed(0)
        for name in nets.NETS:
            net = nets.make(name, 5)
            for layer in net.modules():
                if isinstance(layer, torch.nn.BatchNorm2d):
                    torch.nn.init.uniform_(layer.weight, 0.5, 1.5)
                    layer.running_var.uniform_(0.5, 2)
            image = torch.rand(1, 4, 96, 128) * 100
            with torch.no_grad():
                wanted, got = net.eval()(image), export.folded(net)(image)
            self.assertLess(float((got - wanted).abs().max()), 1e-4 * float(wanted.abs().max()), name)
            self.assertEqual(wanted.shape, (1, 5, 96, 128))


class Scenes(unittest.TestCase):
    def test_a_seed_gives_one_home_and_another_another(self):
        texts = [scenes.Variation(scenes.SCENES / "home.xml", seed).varied() for seed in (3, 3, 4)]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_what_stands_on_furniture_turns_with_it(self):
        variation = scenes.Variation(scenes.SCENES / "home.xml", 0)
        body = xml.Element("body", name="cup_1", pos="1 0 0.7", euler="0 0 10")
        variation.move(body, np.zeros(2), np.array([0.5, 0]), 90)
        np.testing.assert_allclose(scenes.numbers(body.get("pos")), [0.5, 1, 0.7], atol=1e-9)
        self.assertEqual(scenes.numbers(body.get("euler")), [0, 0, 100])


if __name__ == "__main__":
    unittest.main()
