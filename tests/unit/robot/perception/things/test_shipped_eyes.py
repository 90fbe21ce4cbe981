"""The networks that are shipped, on pictures of rooms that they never saw."""

import numpy as np
import pytest

pytest.importorskip("onnxruntime", reason="the extra `vision` is not installed")

from robot.messages import RgbdImage
from robot.perception.things.eyes import Eyes, SeenThing
from robot.perception.things.networks import FINDER, NAMER
from robot.se3 import SE3
from training.things.frames import Frame
from training.things.judging import looks, within
from training.things.scenes import Scene

SEEDS = range(900_000, 900_004)
