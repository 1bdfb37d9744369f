#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Writes the tiny networks of the tests beside this file, with Debian's python3-onnx.

Most are one 1 x 1 convolution over the 64 x 48 images of the tiny recording, whose crate is red, whose wall is
blue and whose background is grey: output channel 0 is background, 1 the crate, 2 the wall. The same script writes
the same bytes.
"""

import pathlib

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

FOLDER = pathlib.Path(__file__).parent
CRATE = [[0, 0, 0], [0.01, -0.01, 0], [0, -0.01, 0.01]]  # by output channel: red, green, blue
BACKGROUND = [1, 0, 0]


def save(name, nodes, shape, given, weights=(), outputs=("logits",), opset=11):
    graph = helper.make_graph(
        nodes, name,
        [helper.make_tensor_value_info("image", TensorProto.FLOAT, shape)],
        [helper.make_tensor_value_info(output, TensorProto.FLOAT, given) for output in outputs],
        [numpy_helper.from_array(np.asarray(values, np.float32), key) for key, values in weights])
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", opset)])
    model.ir_version = 6
    model.producer_name = "tests/network/make_models.py"
    model.producer_version = ""
    onnx.save(model, str(FOLDER / f"{name}.onnx"))


def convolution(name, matrix, bias, shape, then=(), opset=11):
    matrix = np.asarray(matrix, np.float32)
    kernel = matrix.reshape(*matrix.shape, 1, 1)
    output = "scores" if then else "logits"
    nodes = [helper.make_node("Conv", ["image", "kernel", "bias"], [output], kernel_shape=[1, 1])]
    save(name, nodes + list(then), shape, [1, len(matrix), *shape[2:]], [("kernel", kernel), ("bias", bias)], opset=opset)


def with_column(matrix, column):
    return [row + [number] for row, number in zip(matrix, column)]


tiny = [1, 3, 48, 64]
convolution("crate", CRATE, BACKGROUND, tiny)
convolution("crate_half_size", CRATE, BACKGROUND, [1, 3, 24, 32])
convolution("crate_any_size", CRATE, BACKGROUND, [1, 3, "height", "width"])
# Nearer than 2 m is the crate, whatever its colour; no depth is background.
convolution("near", with_column([[0, 0, 0]] * 3, [-8, -1, 1]), [2, 2, -2], [1, 4, 48, 64])
softmax = helper.make_node("Softmax", ["scores"], ["logits"], axis=1)
convolution("crate_softmax", CRATE, BACKGROUND, tiny, [softmax], opset=13)
convolution("crate_sigmoid", CRATE, BACKGROUND, tiny, [helper.make_node("Sigmoid", ["scores"], ["logits"])])
bounds = [helper.make_node("Constant", [], [name], value=numpy_helper.from_array(np.float32(value)))
          for name, value in (("low", 0), ("high", 6))]
save("relu6", [*bounds, helper.make_node("Clip", ["image", "low", "high"], ["logits"])], tiny, tiny)

convolution("wide", CRATE, BACKGROUND, [1, 3, 48, 96])
convolution("five_channels", with_column(with_column(CRATE, [0] * 3), [0] * 3), BACKGROUND, [1, 5, 48, 64])
convolution("opset_17", CRATE, BACKGROUND, tiny, opset=17)
convolution("nan_weights", [[0, 0, 0], [float("nan"), 0, 0], [0, 0, 0]], BACKGROUND, tiny)
save("overflowing", [helper.make_node("Exp", ["image"], ["logits"])], tiny, tiny)
save("unknown_operator", [helper.make_node("Det", ["image"], ["logits"])], tiny, tiny)
save("flat", [helper.make_node("Flatten", ["image"], ["logits"], axis=1)], tiny, [1, 3 * 48 * 64])
save("two_outputs", [helper.make_node("Relu", ["image"], ["a"]), helper.make_node("Abs", ["image"], ["b"])], tiny,
     tiny, outputs=("a", "b"))
