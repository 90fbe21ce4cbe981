"""Writes a learnt network as ONNX, normalisations folded into convolutions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

from training.things.graphs import IMAGE, NUMBERS, Graph
from training.things.networks import EVEN, Learnt

OPSET = 17


def write(
    path: Path, graph: Graph, learnt: Learnt, shapes: dict[str, tuple[Any, ...]],
    notes: dict[str, str],
) -> None:  # fmt: skip
    """Write it.

    Args:
        path: of the file.
        graph: the network.
        learnt: its weights.
        shapes: of what is given, pictures as (rows, columns, channels); how many is left open.
        notes: for the file's metadata.
    """
    nodes: list[Any] = []
    constants: list[Any] = []

    def constant(name: str, value: np.ndarray) -> str:
        constants.append(numpy_helper.from_array(value, name))
        return name

    def node(kind: str, of: list[str], name: str, **options: Any) -> None:
        nodes.append(helper.make_node(kind, of, [name], **options))

    names = {IMAGE: f"{IMAGE}/channels", NUMBERS: NUMBERS}
    node("Transpose", [IMAGE], names[IMAGE], perm=[0, 3, 1, 2])
    weights = {k: np.asarray(v, np.float64) for k, v in learnt.weights.items()}
    even = {k: np.asarray(v, np.float64) for k, v in learnt.even.items()}
    for layer in graph:
        of, name = [names.get(one, one) for one in layer.of], layer.name
        if layer.kind in ("conv", "plain"):
            w, b = weights[f"{name}/w"], weights[f"{name}/b"]
            if layer.kind == "conv":
                scale = weights[f"{name}/g"] / np.sqrt(even[f"{name}/v"] + EVEN)
                w, b = w * scale, b - even[f"{name}/m"] * scale
            pad = layer.size // 2
            of += [constant(f"{name}/w", w.transpose(3, 2, 0, 1).astype(np.float32)),
                   constant(f"{name}/b", b.astype(np.float32))]  # fmt: skip
            out = name if layer.kind == "plain" else f"{name}/sum"
            node("Conv", of, out, kernel_shape=[layer.size] * 2, strides=[layer.stride] * 2,
                 pads=[pad] * 4)  # fmt: skip
            if layer.kind == "conv":
                node("Relu", [out], name)
        elif layer.kind == "fold":
            node("SpaceToDepth", of, name, blocksize=2)
        elif layer.kind == "up":
            of += ["", constant(f"{name}/scales", np.array([1, 1, 2, 2], np.float32))]
            node("Resize", of, name, mode="nearest", nearest_mode="floor",
                 coordinate_transformation_mode="asymmetric")  # fmt: skip
        elif layer.kind == "join":
            node("Concat", of, name, axis=1)
        elif layer.kind == "add":
            node("Add", of, name)
        elif layer.kind == "mean":
            node("ReduceMean", of, name, axes=[2, 3], keepdims=0)
        else:
            of += [constant(f"{name}/w", weights[f"{name}/w"].astype(np.float32)),
                   constant(f"{name}/b", weights[f"{name}/b"].astype(np.float32))]  # fmt: skip
            out = name if layer.kind == "leave" else f"{name}/sum"
            node("Gemm", of, out)
            if layer.kind == "dense":
                node("Relu", [out], name)
    given = [
        helper.make_tensor_value_info(name, TensorProto.FLOAT, ["count", *shape])
        for name, shape in shapes.items()
    ]
    out = ["count", graph[-1].width, *([None, None] if graph[-1].kind == "plain" else [])]
    made = helper.make_tensor_value_info(graph[-1].name, TensorProto.FLOAT, out)
    body = helper.make_graph(nodes, path.stem, given, [made], constants)
    model = helper.make_model(body, opset_imports=[helper.make_opsetid("", OPSET)], ir_version=9)
    helper.set_model_props(model, notes)
    onnx.checker.check_model(model)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(model.SerializeToString())


def note(path: Path, notes: dict[str, Any]) -> None:
    """Write other notes into the metadata of a network; those of other names stay."""
    model = onnx.load(path)
    kept = {one.key: one.value for one in model.metadata_props}
    helper.set_model_props(model, kept | {name: str(value) for name, value in notes.items()})
    path.write_bytes(model.SerializeToString())
