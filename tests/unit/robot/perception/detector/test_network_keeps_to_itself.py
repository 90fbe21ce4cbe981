"""What a network runs on keeps no notes on its use, and sends none away."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from robot.perception.things.networks import FINDER

ROOT = Path(__file__).parents[5]
PACKAGES = ("executive", "intents", "robot", "sim")
RUN = "from pathlib import Path; import sys; from robot.perception.detector.network import session"


def test_nothing_is_left_at_home(tmp_path):
    pytest.importorskip("onnxruntime", reason="the extra `vision` is not installed")
    environment = {"HOME": str(tmp_path), "PATH": os.defpath, "PYTHONPATH": str(ROOT)}
    code = f"{RUN}; session(Path(sys.argv[1]))"
    subprocess.run(
        [sys.executable, "-c", code, str(FINDER)], env=environment, cwd=tmp_path, check=True
    )
    assert list(tmp_path.iterdir()) == []


def test_it_is_asked_to_before_it_is_loaded_wherever_that_is():
    loads = [
        path
        for package in PACKAGES
        for path in (ROOT / package).rglob("*.py")
        if re.search(r"^ +(import|from) onnxruntime", path.read_text(), re.MULTILINE)
    ]
    assert len(loads) == 2
    for path in loads:
        before = path.read_text().split("import onnxruntime")[0]
        assert 'os.environ["ORT_DISABLE_TELEMETRY"] = "1"' in before, path
