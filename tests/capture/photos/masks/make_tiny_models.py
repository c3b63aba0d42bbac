#!/usr/bin/env python3
"""Writes the ONNX models that segmentation_network_test.cpp loads into models/. Needs python3-onnx.

    make_tiny_models.py [FOLDER]

Each model has the input "photo" (1x3x32x32 unless its name says otherwise) and marks red pixels as foreground:
sigmoid(16 r - 16 b), with r and b after preprocessing."""

import pathlib
import sys

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

FLOAT = TensorProto.FLOAT
FP16 = TensorProto.FLOAT16
WEIGHTS = np.array([16, 0, -16], np.float32).reshape(1, 3, 1, 1)


def value(name, shape, kind=FLOAT):
    return helper.make_tensor_value_info(name, kind, shape)


def model(nodes, inputs, outputs, weights):
    graph = helper.make_graph(nodes, "tiny", inputs, outputs, weights)
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=7, producer_name="rayspace")
    return made.SerializeToString()


def conv(output="logits", weights="weights"):
    return helper.make_node("Conv", ["photo", weights], [output], name="/conv", kernel_shape=[1, 1])


def sigmoid(source="logits", output="mask"):
    return helper.make_node("Sigmoid", [source], [output], name="/" + output)


def weights(array=WEIGHTS, name="weights"):
    return numpy_helper.from_array(array, name)


PHOTO = value("photo", [1, 3, 32, 32])
MASK = value("mask", [1, 1, 32, 32])

two_outputs = [conv(), sigmoid("logits", "side"), helper.make_node("Neg", ["logits"], ["negated"], name="/neg"),
               sigmoid("negated", "mask")]
external = weights()
external.data_location = TensorProto.EXTERNAL
external.ClearField("raw_data")
short = weights()
short.raw_data = short.raw_data[:-4]
entry = external.external_data.add()
entry.key, entry.value = "location", "weights.bin"

models = {
    "plain": model([conv(), sigmoid()], [PHOTO], [MASK], [weights()]),
    # IR version 3 lists weights among the inputs.
    "weights_as_inputs": model([conv(), sigmoid()], [PHOTO, value("weights", [1, 3, 1, 1])], [MASK], [weights()]),
    "logits": model([conv("mask")], [PHOTO], [MASK], [weights()]),
    "dynamic": model([conv(), sigmoid()], [value("photo", ["n", 3, "h", "w"])], [value("mask", ["n", 1, "h", "w"])],
                     [weights()]),
    "half_output": model([helper.make_node("Conv", ["photo", "weights"], ["logits"], kernel_shape=[1, 1], strides=[2, 2]),
                          sigmoid()], [PHOTO], [value("mask", [1, 1, 16, 16])], [weights()]),
    # The first output is the result, as in U2-Net; here the other one comes first among the nodes.
    "two_outputs": model(two_outputs, [PHOTO], [MASK, value("side", [1, 1, 32, 32])], [weights(-WEIGHTS)]),
    "fp16": model([conv(), sigmoid()], [value("photo", [1, 3, 32, 32], FP16)], [value("mask", [1, 1, 32, 32], FP16)],
                  [weights(WEIGHTS.astype(np.float16))]),
    "quantized": model([helper.make_node("DynamicQuantizeLinear", ["photo"], ["q", "scale", "zero"]),
                        helper.make_node("ConvInteger", ["q", "weights", "zero"], ["sum"], kernel_shape=[1, 1]),
                        helper.make_node("Cast", ["sum"], ["logits"], to=FLOAT), sigmoid()],
                       [PHOTO], [MASK], [weights(WEIGHTS.astype(np.int8))]),
    "external": model([conv(), sigmoid()], [PHOTO], [MASK], [external]),
    "short_weights": model([conv(), sigmoid()], [PHOTO], [MASK], [short]),
    "two_inputs": model([helper.make_node("Add", ["photo", "second"], ["sum"]),
                         helper.make_node("Conv", ["sum", "weights"], ["logits"], kernel_shape=[1, 1]), sigmoid()],
                        [PHOTO, value("second", [1, 3, 32, 32])], [MASK], [weights()]),
    "grey": model([conv(), sigmoid()], [value("photo", [1, 1, 32, 32])], [MASK],
                  [weights(np.ones((1, 1, 1, 1), np.float32))]),
    "large": model([conv(), sigmoid()], [value("photo", [1, 3, 4096, 4096])], [value("mask", [1, 1, 4096, 4096])],
                   [weights()]),
    "classes": model([conv(), sigmoid()], [PHOTO], [value("mask", [1, 2, 32, 32])],
                     [weights(np.concatenate([WEIGHTS, -WEIGHTS]))]),
    "nan": model([conv(), helper.make_node("Sqrt", ["logits"], ["mask"])], [PHOTO], [MASK], [weights()]),
    "unknown_operator": model([conv(), helper.make_node("Mystery", ["logits"], ["mask"], domain="")], [PHOTO], [MASK],
                              [weights()]),
}
models["truncated"] = models["plain"][:-40]

folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "models"
for name, content in models.items():
    (folder / f"{name}.onnx").write_bytes(content)
