"""The executive of a live run is killed in physics: the robot stays up, and the run goes on."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

from executive import journal
from tests.fakes.waiting import eventually

WORDS = "squat for three seconds, then say hello, then squat for nine seconds"


def executives(job: int) -> list[int]:
    """Process ids of a job's executives: the one at work, then the spare."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"executive.main" in words and str(job).encode() in words:
            found.append((words[-2], int(entry.name)))
    return [pid for _, pid in sorted(found)]


def said(folder: Path, kind: str, **data) -> bool:
    try:
        events = journal.read(folder)
    except Exception:  # not there yet
        return False
    return any(e.event == kind and data.items() <= e.data.items() for e in events)


def test_a_killed_executive_is_followed_by_one_that_goes_on(tmp_path):
    folder = tmp_path / "run"
    command = [sys.executable, "-m", "executive", "do", WORDS, "--run-dir", str(folder), "--json"]
    job = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    try:
        third = {"step": "squat for 9 s", "phase": "holding (squat)"}
        assert eventually(lambda: said(folder, "phase", **third), within_s=120.0)
        os.kill(executives(job.pid)[0], signal.SIGKILL)
        assert eventually(lambda: said(folder, "resumed"), within_s=60.0)
        out, err = job.communicate(timeout=120.0)
    finally:
        if job.poll() is None:
            os.killpg(job.pid, signal.SIGKILL)
    assert job.returncode == 0, err
    assert json.loads(out)["status"] == "done"
    assert "The executive was killed by SIGKILL" in err
    events = journal.read(folder)
    assert [event.n for event in events] == list(range(len(events)))
    done = [event.data["id"] for event in events if event.event == "done"]
    assert done == ["1", "2", "3"]
    (resumed,) = [event for event in events if event.event == "resumed"]
    assert len(resumed.data["done"]) == 2
    modes = {e.data["mode"] for e in events if e.event == "pose" and "mode" in e.data}
    assert modes == {"stand"}
    assert eventually(lambda: not executives(job.pid), within_s=5.0)
