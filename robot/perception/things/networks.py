# pyright: basic
# onnxruntime is optional (extra: vision).
"""The finder and the namer: networks of our own, in files beside this one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from robot.perception.detector.network import session
from robot.perception.things.inputs import Floats

HERE = Path(__file__).parent
FINDER, NAMER = HERE / "finder.onnx", HERE / "namer.onnx"


class Finder:
    """Pictures in, what it says of each second pixel out (`instances`)."""

    def __init__(self, path: Path = FINDER) -> None:
        """Load it. Raises ConfigError if onnxruntime is missing, or the file is no network."""
        self._session: Any = session(path)

    def __call__(self, tensor: Floats) -> Floats:
        """Its answers to one picture (`inputs.tensor`), shape (3, rows, columns)."""
        return np.asarray(self._session.run(None, {"image": tensor[None]})[0][0], np.float32)


class Namer:
    """Crops in, what they are, where, how large out.

    Attributes:
        classes: what it tells apart; "" is what has no name, "nothing" what is no thing.
        families: of each class; of the last two they are the same.
        sure: what `eyes` takes for certain: of a kind, of a family.
    """

    def __init__(self, path: Path = NAMER) -> None:
        """Load it. Raises ConfigError if onnxruntime is missing, or the file is no network."""
        self._session: Any = session(path)
        notes: dict[str, str] = self._session.get_modelmeta().custom_metadata_map
        self.classes = tuple(notes["classes"].split(","))
        self.families = tuple(notes["families"].split(","))
        self.sure = float(notes["sure_kind"]), float(notes["sure_family"])
        self.spread = float(notes["spread"])
        self.heat = float(notes["heat"])

    def __call__(self, planes: Floats, numbers: Floats) -> Floats:
        """Its answers, a row a crop: `crops.SIDE_PX` planes, and numbers."""
        if not len(planes):
            return np.empty((0, len(self.classes) + 10), dtype=np.float32)
        given = {"image": planes, "numbers": numbers}
        return np.asarray(self._session.run(None, given)[0], np.float32)
