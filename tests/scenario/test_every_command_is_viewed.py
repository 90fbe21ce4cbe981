"""Every command that moves the robot as a whole is looked at on a page, and stopped from there."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
import typer

from executive.frontends.cli import app
from executive.frontends.console.desk import FILE
from executive.journal import motion, reader
from robot.reality import trail
from tests.fakes.waiting import HANG_S

MOVING = ("do", "repl", "listen", "mission run", "walk", "up", "resume")
COMMAND = (sys.executable, "-c", "from executive.frontends.cli import main; main()")


@pytest.mark.parametrize("name", MOVING)
def test_it_has_a_page_and_a_recording(name):
    command = typer.main.get_command(app)
    for part in name.split():
        command = command.get_command(None, part)
    options = {option for one in command.params for option in one.opts}
    assert {"--view", "--record"} <= options


@pytest.mark.slow
def test_a_walk_is_looked_at_and_stopped_from_its_page(tmp_path):
    folder = tmp_path / "run"
    walking = subprocess.Popen(
        [*COMMAND, "walk", "--fast", "--for", "600", "--view", "--run-dir", str(folder)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(Path.cwd())},
    )  # fmt: skip
    try:
        limit_s = time.monotonic() + HANG_S
        while not ((folder / FILE).is_file() and motion.last_s(folder) > 3.0):
            assert walking.poll() is None and time.monotonic() < limit_s
            time.sleep(0.05)
        with socket.socket(socket.AF_UNIX) as page:
            page.connect(json.loads((folder / FILE).read_text())["socket"])
            page.sendall(b'{"line":"go to the table"}\n{"do":"stop"}\n')
            out, _ = walking.communicate(timeout=HANG_S)
    finally:
        walking.kill()
    assert walking.returncode == 1
    assert "Watch it here: http://127.0.0.1:" in out
    assert "takes no orders but `stop`" in out
    run = reader.read(folder)
    assert [ending.code for ending in run.endings] == ["cancelled"]
    assert run.endings[0].t_s < 599.0
    moments = list(motion.read(folder))
    assert moments[-1].base[0] - moments[0].base[0] > 0.1
    assert all(trail.decode(line) for line in (folder / trail.FILE).read_bytes().splitlines())
