"""The executive of a live run is killed in physics: the robot stays up, and the run goes on."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from executive.journal import journal
from executive.journal.journal import Event
from tests.fakes.executives import executives
from tests.fakes.waiting import HANG_S, eventually

pytestmark = pytest.mark.live

WORDS = "say hello, then put the red cup on the sideboard"


class Run:
    """A live run of a sentence in the world `bench`.

    An oracle sees for it: perception is not killed, and own eyes take a third of the machine.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.job = subprocess.Popen(
            [sys.executable, "-m", "executive", "do", WORDS, "--world", "bench",
             "--eyes", "oracle", "--json", "--run-dir", str(folder)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )  # fmt: skip

    def events(self, kind: str) -> list[Event]:
        try:
            return [event for event in journal.read(self.folder) if event.event == kind]
        except Exception:  # not there yet
            return []

    def kill_while(self, phase: str) -> None:
        """Kill the executive a few steps after a phase has begun, when its spare is there."""
        has_begun = lambda: any(phase in e.data["phase"] for e in self.events("phase"))  # noqa: E731
        assert eventually(has_begun), phase
        poses = len(self.events("pose"))
        assert eventually(lambda: len(self.events("pose")) > poses + 3)
        assert eventually(lambda: len(executives(self.job.pid)) == 2)
        first, self.spare = executives(self.job.pid)
        os.kill(first, signal.SIGKILL)


@pytest.fixture
def run(tmp_path):
    made = Run(tmp_path / "run")
    yield made
    if made.job.poll() is None:
        os.killpg(made.job.pid, signal.SIGKILL)


@pytest.mark.slow
def test_it_goes_on_when_killed_while_walking_and_while_carrying(run):
    run.kill_while("walking to the red cup")
    assert eventually(lambda: len(run.events("resumed")) == 1)
    assert executives(run.job.pid)[0] == run.spare
    run.kill_while("walking to the sideb")
    out, err = run.job.communicate(timeout=HANG_S)
    assert run.job.returncode == 0, err
    summary = json.loads(out)
    assert summary["status"] == "done"
    assert [item["where"] for item in summary["placed"]] == ["on the sideboard"]
    assert err.count("The executive was killed by SIGKILL") == 2

    assert [event.n for event in journal.read(run.folder)] == list(
        range(len(journal.read(run.folder)))
    )
    assert len(run.events("said")) == 1
    assert [event.data["id"] for event in run.events("done")] == ["1", "2.1", "2.2"]
    walking, carrying = run.events("resumed")
    assert walking.data["done"] == ["1"]
    assert carrying.data["done"] == ["1", "2.1"]
    assert "in the hand: red_cup" in carrying.data["why"]
    modes = {event.data["mode"] for event in run.events("pose") if "mode" in event.data}
    assert modes == {"stand", "walk"}
    assert eventually(lambda: not executives(run.job.pid))
