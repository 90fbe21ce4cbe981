"""`humanoid eval` and signals: it ends soon, keeps what is done, and leaves nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from executive.evaluation.record import FILE
from tests.fakes.waiting import eventually


@pytest.mark.parametrize(
    ("number", "times"),
    [
        (signal.SIGINT, 1),
        pytest.param(signal.SIGINT, 2, marks=pytest.mark.rest),
        (signal.SIGHUP, 1),
    ],
)
def test_a_signal_to_all_of_it_ends_it_and_says_how_to_go_on(tmp_path, number, times):
    words = ["eval", "--faults", "object gone", "--seeds", "2", "-j", "2"]
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with subprocess.Popen(
        [Path(sys.executable).with_name("humanoid"), *words],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(temporary)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as command:
        assert eventually(lambda: [*temporary.glob("humanoid-eval-*/*")])  # a run is under way
        for _ in range(times):
            os.killpg(command.pid, number)
        _, errors = command.communicate()
    (results,) = tmp_path.glob(f"runs/*-eval/{FILE}")
    assert command.returncode == 1
    assert "0 runs are kept, 2 are left" in errors
    assert f"--resume {results.parent.relative_to(tmp_path)}" in errors
    assert "Traceback" not in errors
    assert not [*temporary.iterdir()]
    assert eventually(lambda: not alive(command.pid))


def alive(group: int) -> list[str]:
    """The processes of a group, those that only wait to be reaped left out."""
    found = subprocess.check_output(["ps", "-eo", "pgid=,stat=,args="], text=True)
    lines = [line.split(maxsplit=2) for line in found.splitlines()]
    return [args for pgid, stat, args in lines if int(pgid) == group and stat[0] != "Z"]
