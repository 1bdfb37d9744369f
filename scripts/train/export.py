# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes a trained network as ONNX that OpenCV 4.6 reads, and checks that OpenCV says what PyTorch says.

Batch normalisation is folded into the convolutions before it, pools have fixed kernels: one input `image`
of 1 x C x 240 x 320, one output `logits`. Weights are single floats: OpenCV 4.6 reads no half ones.
"""

import copy

import cv2
import numpy as np
import onnx
import torch
from torch import nn
from torch.nn.utils.fusion import fuse_conv_bn_eval

from data import HEIGHT, WIDTH

OPSET = 11
MOST_BYTES = 1_000_000
MOST_DIFFERENCE = 1e-4      # of logits, relative to the greatest


def folded(net):
    """A copy whose batch normalisation is part of the convolutions."""
    net = copy.deepcopy(net).eval()
    for parent in list(net.modules()):
        if not isinstance(parent, nn.Sequential):
            continue
        layers = list(parent)
        for n, (first, second) in enumerate(zip(layers, layers[1:])):
            if isinstance(first, nn.Conv2d) and isinstance(second, nn.BatchNorm2d):
                parent[n] = fuse_conv_bn_eval(first, second)
        kept = [layer for layer in parent if not isinstance(layer, nn.BatchNorm2d)]
        while len(parent):
            del parent[-1]
        parent.extend(kept)
    return net.to(memory_format=torch.contiguous_format)


def write(net, channels, file):
    """Writes a folded network. The bytes depend on its weights alone."""
    image = torch.zeros(1, channels, HEIGHT, WIDTH)
    torch.onnx.export(net, image, str(file), opset_version=OPSET, input_names=["image"],
                      output_names=["logits"], do_constant_folding=True)
    model = onnx.load(str(file))
    model.producer_name, model.producer_version, model.doc_string = "mapscore", "", ""
    for node in model.graph.node:
        node.doc_string = ""
    onnx.checker.check_model(model)
    onnx.save(model, str(file))
    if file.stat().st_size > MOST_BYTES:
        raise SystemExit(f"{file}: {file.stat().st_size} bytes, at most {MOST_BYTES}; choose narrower stages")


def logits_of(file, image):
    """What OpenCV's DNN module computes for an image (1, C, H, W)."""
    network = cv2.dnn.readNetFromONNX(str(file))
    network.setInput(image, "image")
    return network.forward("logits")


def difference(file, net, image):
    """Greatest difference of OpenCV's logits from PyTorch's, relative to the greatest of these."""
    with torch.no_grad():
        wanted = net(torch.from_numpy(image)).numpy()
    return float(np.abs(logits_of(file, image) - wanted).max() / np.abs(wanted).max())


def export(net, channels, file, image):
    """Writes and checks; returns the folded network, which is the one to score."""
    deployed = folded(net)
    write(deployed, channels, file)
    off = difference(file, deployed, image)
    if off > MOST_DIFFERENCE:
        raise SystemExit(f"{file}: OpenCV differs from PyTorch by {off:.2e} of the greatest logit")
    return deployed
