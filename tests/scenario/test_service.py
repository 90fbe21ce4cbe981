"""A robot that is up: reached, stopped, killed and ended by real processes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from executive.frontends.service import place as places
from executive.journal import journal
from tests.fakes.executives import executives
from tests.fakes.terminal import CTRL_C, CTRL_D, Terminal
from tests.fakes.waiting import HANG_S, eventually

pytestmark = pytest.mark.slow

ROUND = ", then ".join(["walk 1.5 m forward, then walk 1.5 m back"] * 4)


class Service:
    """The commands of a user who has a runtime folder of their own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.environment = {**os.environ, "XDG_RUNTIME_DIR": str(folder)}

    def __call__(self, *words: str, stdin: str = "") -> tuple[int, str]:
        done = subprocess.run(
            [sys.executable, "-m", "executive", *words], cwd=self.folder, env=self.environment,
            input=stdin, capture_output=True, text=True, timeout=HANG_S, check=False,
        )  # fmt: skip
        return done.returncode, done.stdout + done.stderr

    @property
    def pid(self) -> int:
        return json.loads((self.folder / "humanoid/robot" / places.RUNNING).read_text())["pid"]

    @property
    def standing(self) -> dict:
        return json.loads(self("status", "--json")[1])

    def events(self, kind: str) -> list[journal.Event]:
        (run,) = (self.folder / "runs").iterdir()
        return [event for event in journal.read(run) if event.event == kind]


@pytest.fixture
def humanoid(tmp_path):
    folder = tmp_path / "here"
    folder.mkdir(mode=0o700)
    made = Service(folder)
    yield made
    with suppress(OSError, ValueError):
        os.kill(made.pid, signal.SIGKILL)


def test_a_fast_robot_is_talked_to_from_other_terminals(humanoid):
    status, said = humanoid("up", "--detach", "--fast", "--world", "empty")
    assert status == 0, said
    assert humanoid("up", "--fast", "--world", "empty")[0] == 2  # the name is taken
    status, said = humanoid("say", "--wait", "squat for 1 second, then say hello")
    assert (status, "says: Hello" in said) == (0, True), said
    assert humanoid("say", "put the plumbus on the moon")[0] == 2
    assert humanoid("say", "--wait", "where are you?")[0] == 0
    status, said = humanoid("attach", stdin="squat for 1 second\nwhy\nquit\n")
    assert (status, "Done (2)" in said) == (0, True), said
    assert humanoid.standing["state"] == "idle"  # whoever was attached has left it as it was
    status, said = humanoid("logs")
    assert (status, "(shell) > squat for 1 second" in said) == (0, True), said
    status, said = humanoid("down")
    assert (status, said.splitlines()[-1]) == (0, "robot is down.")
    assert humanoid("status")[0] == 2


@pytest.mark.live
def test_a_stop_reaches_a_robot_whose_executive_is_killed_and_nothing_goes_on(humanoid):
    assert humanoid("up", "--detach", "--world", "empty")[0] == 0
    assert humanoid("say", ROUND)[0] == 0
    pid = humanoid.pid
    assert eventually(lambda: len(executives(pid)) == 2)
    os.kill(executives(pid)[0], signal.SIGKILL)
    status, said = humanoid("stop")
    assert status == 0, said
    assert eventually(lambda: humanoid.standing["state"] == "idle")
    assert humanoid.standing["jobs"] == []
    assert humanoid("say", "--wait", "say hello")[0] == 0  # it is the same robot, and still up
    os.kill(pid, signal.SIGTERM)
    assert eventually(lambda: humanoid("status")[0] == 2)
    assert [event.data["text"] for event in humanoid.events("said")] == ["Hello."]


@pytest.mark.live
@pytest.mark.rest
def test_a_prompt_that_is_attached_shows_it_at_work_and_leaves_it_so(humanoid, monkeypatch):
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(humanoid.folder))
    assert humanoid("up", "--detach", "--world", "empty")[0] == 0
    with Terminal("attach", folder=humanoid.folder) as screen:
        assert screen.shows("healthy")  # the status line, of a robot that another process keeps up
        screen.enter(ROUND)
        assert eventually(lambda: len(humanoid.standing["jobs"]) == 1)
        assert screen.shows("walk 1.5 m")
        screen.press(CTRL_C)
        assert eventually(lambda: humanoid.standing["jobs"] == [])
        screen.enter(ROUND)
        assert eventually(lambda: len(humanoid.standing["jobs"]) == 1)
        screen.press(CTRL_D)
        assert eventually(lambda: screen.process.poll() is not None)
    assert screen.process.returncode == 0
    assert len(humanoid.standing["jobs"]) == 1
    assert humanoid("down")[0] == 0
