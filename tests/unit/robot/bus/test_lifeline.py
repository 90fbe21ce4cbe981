"""A process that is tied to another one ends with it, whenever that ended, and without a word."""

import os
import signal
import subprocess
import sys

import pytest

from robot.bus.lifeline import Turn


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


def test_who_keeps_the_robot_up_comes_before_who_sees_and_all_of_them_before_others():
    ladder = [Turn.BODY, Turn.SENSES, Turn.PLANNING, Turn.PICTURES, Turn.OTHERS]
    assert ladder == sorted(ladder) and len(set(ladder)) == len(ladder)
    assert Turn.OTHERS == 0


@pytest.mark.parametrize("turn", [Turn.SENSES, Turn.PICTURES])
def test_a_turn_is_granted_and_counts_or_all_stays_as_it_was(turn):
    code = (
        "import os; from robot.bus.lifeline import Turn, ask_for_turn; "
        "before = os.getpriority(os.PRIO_PROCESS, 0); "
        f"granted = ask_for_turn(Turn.{turn.name}); "
        "now = os.getpriority(os.PRIO_PROCESS, 0); "
        f"assert now == ({int(turn)} if granted else before), (granted, before, now)"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert ended.returncode == 0, ended.stderr
