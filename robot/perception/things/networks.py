# pyright: basic
"""The finder and the namer: networks of our own, in files beside this one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from robot.perception.detector.network import session
from robot.perception.things import usual_sizes
from robot.perception.things.inputs import Floats
from robot.perception.things.instances import HALF
from robot.perception.things.naming import Classes, Sure

HERE = Path(__file__).parent
FINDER, NAMER = HERE / "finder.onnx", HERE / "namer.onnx"
STEP_PX = 16


class Finder:
    """Pictures in, what it says of each second pixel out (`instances`)."""

    def __init__(self, path: Path = FINDER) -> None:
        """Load it. Raises ConfigError if onnxruntime is missing, or the file is no network."""
        self._session: Any = session(path)

    def __call__(self, tensor: Floats) -> Floats:
        """Its answers to one picture (`inputs.tensor`), shape (3, rows, columns)."""
        rows, columns = tensor.shape[:2]
        # Its levels halve four times: what is missing to that is grey without depth.
        missing = (0, -rows % STEP_PX), (0, -columns % STEP_PX), (0, 0)
        given = np.pad(tensor, missing) if -rows % STEP_PX or -columns % STEP_PX else tensor
        said = np.asarray(self._session.run(None, {"image": given[None]})[0][0], np.float32)
        return said[:, : rows // HALF, : columns // HALF]


class Namer:
    """Crops in, what they are, where, how large out.

    Attributes:
        classes: what it tells apart.
        sure: what it was found to be right about, in one look.
        voted: the same over several looks (`votes`), which make it surer of itself, also where it
            is wrong: of a kind that it never learnt. A family, which is at least as likely as each
            of its kinds, has to be as sure.
        heat: by how much it is too sure of itself.
        spread: by how much its errors of places are larger than it says.
    """

    def __init__(self, path: Path = NAMER) -> None:
        """Load it. Raises ConfigError if onnxruntime is missing, or the file is no network."""
        self._session: Any = session(path)
        notes: dict[str, str] = self._session.get_modelmeta().custom_metadata_map
        names, families = (tuple(notes[one].split(",")) for one in ("classes", "families"))
        sizes = usual_sizes.read(notes["sizes"], names) if "sizes" in notes else None
        self.classes = Classes(names, families, sizes)
        self.sure = Sure(float(notes["sure_kind"]), float(notes["sure_family"]))
        voted_kind = float(notes.get("sure_voted_kind", notes["sure_kind"]))
        self.voted = Sure(voted_kind, max(voted_kind, self.sure.family))
        self.heat, self.spread = float(notes["heat"]), float(notes["spread"])

    def __call__(self, planes: Floats, numbers: Floats) -> Floats:
        """Its answers, a row a crop: `crops.SIDE_PX` planes, and numbers."""
        if not len(planes):
            return np.empty((0, len(self.classes.names) + 10), dtype=np.float32)
        given = {"image": planes, "numbers": numbers}
        return np.asarray(self._session.run(None, given)[0], np.float32)
