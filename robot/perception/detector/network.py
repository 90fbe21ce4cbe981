# pyright: basic
"""A network from an ONNX file, run by onnxruntime on the processor."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_ordinary
from robot.perception.detector import onnx_file

INSTALL = "pip install onnxruntime"
EXPORT = "export one to ONNX: yolo export model=yolo11n.pt format=onnx"
MOST_BYTES = 300_000_000
"""The largest YOLO has 230 MB; onnxruntime takes several times as much to run it."""
USUAL_PX, MOST_PX = 640, 4096
"""Of networks that take pictures of any size; of those that take one size."""


def session(path: Path, *, cure: str = EXPORT) -> Any:
    """A network out of a file, ready to run on one thread.

    Args:
        path: of the file; weights within it.
        cure: what to do where it holds no network.

    Raises:
        ConfigError: onnxruntime is missing, or the file holds no network.
    """
    # Its builds since 1.31 otherwise note what is run with it, under an identifier that they keep
    # in ~/.cache, and send that away; it is asked before the library is loaded, or not at all.
    os.environ["ORT_DISABLE_TELEMETRY"] = "1"
    try:
        import onnxruntime
    except ImportError:
        problem = Problem("onnxruntime is not installed", suggestion=INSTALL)
        raise ConfigError([problem]) from None
    try:
        data = read_ordinary(path, limit=MOST_BYTES)
    except OSError as error:
        raise _wrong(path, error.strerror or "it cannot be read", cure) from None
    no_network = "this is no network in ONNX that can be run"
    try:
        is_whole = onnx_file.is_whole(data)
    except ValueError:
        raise _wrong(path, no_network, cure) from None
    if not is_whole:
        raise _wrong(path, "parts of this network are in other files, which are not read", cure)
    options = onnxruntime.SessionOptions()
    options.add_session_config_entry("session.load_model_format", "ONNX")
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    # Its threads otherwise spin for 47 to 500 ms after a run, on a core that others need.
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    options.log_severity_level = 4  # what is wrong is told below, in a sentence
    try:
        return onnxruntime.InferenceSession(data, options, providers=["CPUExecutionProvider"])
    except Exception:  # onnxruntime has many, and they share no base
        raise _wrong(path, no_network, cure) from None


def _wrong(path: Path, message: str, cure: str) -> ConfigError:
    return ConfigError([Problem(message=message, file=str(path), suggestion=cure)])


class Network:
    """Pictures in, numbers out."""

    def __init__(self, path: Path) -> None:
        """Load it, weights within the file.

        Raises:
            ConfigError: onnxruntime is missing, or the file holds no network that takes a picture.
        """
        self._path = path
        self._session: Any = session(path)
        inputs = self._session.get_inputs()
        if len(inputs) != 1 or len(inputs[0].shape) != 4 or inputs[0].shape[1] != 3:
            raise self._wrong("this network does not take one picture in red, green and blue")
        if inputs[0].type not in ("tensor(float)", "tensor(float16)"):
            raise self._wrong(f"this network takes {inputs[0].type}, and not floating numbers")
        self._name, self._kind = inputs[0].name, inputs[0].type
        sides = [side if isinstance(side, int) else USUAL_PX for side in inputs[0].shape[2:]]
        if not all(1 <= side <= MOST_PX for side in sides):
            raise self._wrong(f"this network takes pictures of more than {MOST_PX} px a side")
        self.size = (sides[1], sides[0])
        """Width and height of the pictures that it takes."""

    def __call__(self, tensor: NDArray[np.float32]) -> NDArray[np.float32]:
        """The first output for a picture, shape (1, 3, height, width).

        Raises:
            ConfigError: the network cannot be run on it.
        """
        kind = np.float16 if self._kind == "tensor(float16)" else np.float32
        try:
            output = self._session.run(None, {self._name: tensor.astype(kind)})[0]
            with np.errstate(over="ignore"):  # of wider numbers: infinite
                return np.asarray(output, dtype=np.float32)
        except Exception:  # as above; or an output that is no array of numbers
            raise self._wrong("this network failed on a picture") from None

    def _wrong(self, message: str) -> ConfigError:
        return _wrong(self._path, message, EXPORT)
