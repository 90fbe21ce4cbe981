"""A process that is tied to another one ends with it, whenever that ended, and without a word."""

import os
import signal
import subprocess
import sys

import pytest


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel of Linux does it")
def test_a_process_whose_parent_is_gone_already_dies_as_if_it_went_now():
    """Whoever is killed while its processes begin leaves no tracebacks of theirs behind."""
    code = "from robot.bus.lifeline import tie_to_parent; tie_to_parent({}); print('alive')"
    orphan = [sys.executable, "-c", code.format(1 if os.getpid() != 1 else 2)]
    ended = subprocess.run(orphan, capture_output=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (-signal.SIGKILL, b"", b"")
    tied = [sys.executable, "-c", code.format(os.getpid())]
    ended = subprocess.run(tied, capture_output=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, b"alive\n", b"")
