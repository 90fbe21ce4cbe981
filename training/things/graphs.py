"""The two networks as lists of layers: what learns them and what writes their file walk the same.

Both are small enough for one thread of an ordinary processor; `cost` counts their products.
"""

from __future__ import annotations

from typing import NamedTuple

from robot.perception.things import crops, inputs

IMAGE = "image"
NUMBERS = "numbers"


class Layer(NamedTuple):
    """A layer: what it makes, out of what, and how.

    Attributes:
        kind: "conv" (with a normalisation that is folded into it, and a rectifier), "plain" (a
            convolution alone), "fold" (2 x 2 pixels become channels), "up" (twice as large),
            "join" (channels side by side), "add", "mean" (over the picture), "dense" (and
            a rectifier), "leave" (dense alone).
        width: channels that come out; 0: as many as come in.
        size, stride: of a convolution.
    """

    name: str
    kind: str
    of: tuple[str, ...]
    width: int = 0
    size: int = 3
    stride: int = 1


Graph = tuple[Layer, ...]


def finder() -> Graph:
    """A U of four levels: which pixels are of a thing, and where the middle of that is."""
    return (
        Layer("fold", "fold", (IMAGE,)),
        Layer("a0", "conv", ("fold",), 16, size=1),
        Layer("a", "conv", ("a0",), 16),
        Layer("b0", "conv", ("a",), 24, stride=2),
        Layer("b", "conv", ("b0",), 24),
        Layer("c0", "conv", ("b",), 40, stride=2),
        Layer("c1", "conv", ("c0",), 40),
        Layer("c", "add", ("c0", "c1")),
        Layer("d0", "conv", ("c",), 64, stride=2),
        Layer("d1", "conv", ("d0",), 64),
        Layer("d2", "add", ("d0", "d1")),
        Layer("d3", "conv", ("d2",), 64),
        Layer("d4", "conv", ("d3",), 40, size=1),
        Layer("cu", "up", ("d4",)),
        Layer("cj", "add", ("c", "cu")),
        Layer("ce", "conv", ("cj",), 40),
        Layer("ce2", "conv", ("ce",), 24, size=1),
        Layer("bu", "up", ("ce2",)),
        Layer("bj", "add", ("b", "bu")),
        Layer("be", "conv", ("bj",), 24),
        Layer("be2", "conv", ("be",), 16, size=1),
        Layer("au", "up", ("be2",)),
        Layer("aj", "add", ("a", "au")),
        Layer("ae", "conv", ("aj",), 16),
        Layer("out", "plain", ("ae",), 3, size=1),
    )


def namer(classes: int) -> Graph:
    """Convolutions, a mean, and what is known besides: class, place, size, which way it stands.

    What comes out, in this order: a number a class; the place of the middle along, across and up,
    and the logarithms of their variances; three sizes; upright.
    """
    return (
        Layer("a", "conv", (IMAGE,), 32, stride=2),
        Layer("a1", "conv", ("a",), 32),
        Layer("a2", "add", ("a", "a1")),
        Layer("b", "conv", ("a2",), 64, stride=2),
        Layer("b1", "conv", ("b",), 64),
        Layer("b2", "add", ("b", "b1")),
        Layer("b3", "conv", ("b2",), 64),
        Layer("b4", "add", ("b2", "b3")),
        Layer("c", "conv", ("b4",), 128, stride=2),
        Layer("c1", "conv", ("c",), 128),
        Layer("c2", "add", ("c", "c1")),
        Layer("c3", "conv", ("c2",), 128),
        Layer("c4", "add", ("c2", "c3")),
        Layer("d", "conv", ("c4",), 160, stride=2),
        Layer("d1", "conv", ("d",), 160),
        Layer("d2", "add", ("d", "d1")),
        Layer("mean", "mean", ("d2",)),
        Layer("known", "dense", (NUMBERS,), 32),
        Layer("both", "join", ("mean", "known")),
        Layer("mixed", "dense", ("both",), 160),
        Layer("out", "leave", ("mixed",), classes + REST),
    )


REST = 3 + 3 + 3 + 1
"""Numbers that the namer gives beside those of the classes."""


def widths(graph: Graph, given: dict[str, int]) -> dict[str, int]:
    """How many channels every layer has, from those of what is given."""
    found = dict(given)
    for layer in graph:
        into = [found[one] for one in layer.of]
        kept = {"fold": 4 * into[0], "join": sum(into)}.get(layer.kind, into[0])
        found[layer.name] = layer.width or kept
    return found


def cost(graph: Graph, given: dict[str, int], shape: tuple[int, int]) -> int:
    """Products of one picture of so many rows and columns."""
    sizes, sides, total = widths(graph, given), dict.fromkeys(given, shape), 0
    for layer in graph:
        rows, columns = sides[layer.of[0]]
        if layer.kind in ("conv", "plain"):
            rows, columns = -(-rows // layer.stride), -(-columns // layer.stride)
            total += rows * columns * layer.size**2 * sizes[layer.of[0]] * sizes[layer.name]
        elif layer.kind == "fold":
            rows, columns = rows // 2, columns // 2
        elif layer.kind == "up":
            rows, columns = rows * 2, columns * 2
        elif layer.kind in ("dense", "leave"):
            total += sizes[layer.of[0]] * sizes[layer.name]
        sides[layer.name] = rows, columns
    return total


FINDER_IN = {IMAGE: inputs.CHANNELS}
NAMER_IN = {IMAGE: crops.CHANNELS, NUMBERS: crops.NUMBERS}
