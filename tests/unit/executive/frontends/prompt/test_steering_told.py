"""What commands that steer say is what comes of them."""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path

import pytest

from executive.frontends.prompt.shell import Shell
from tests.fakes.puppet_shell import puppet_shell

said: list[str] = []


@pytest.fixture
def shell(tmp_path: Path) -> Generator[Shell]:
    said.clear()
    with puppet_shell(tmp_path, said) as made:
        yield made
        made.brake.stop("the test is over")


def test_a_place_beyond_the_queue_is_its_last(shell: Shell) -> None:
    for line in ("walk to the shelf", "wave", "walk to the table", "walk to the doorway"):
        shell.line(line)
    shell.line("goals move 2 9")
    lasts = (2, 3)  # the first job may have begun by then, or not
    assert said[-1] in [f"Job 2 waits at place {n}, the last; 0 is next." for n in lasts]
    shell.line("goals move 2 0")
    assert said[-1] == "Job 2 waits at place 0; 0 is next."


@pytest.mark.parametrize("line", ["resume", "continue"])
def test_with_the_emergency_stop_on_nothing_is_under_way(shell: Shell, line: str) -> None:
    shell.line("walk to the shelf")
    shell.line("estop")
    shell.line(line)
    assert said[-1].startswith("The emergency stop is on, and nothing moves")


def test_a_pause_under_the_emergency_stop_is_told_with_it_and_after_it(shell: Shell) -> None:
    shell.line("estop")
    shell.line("pause")
    assert "The emergency stop is on" in said[-1]
    assert "paused after that" in said[-1]
    shell.line("estop release")
    shell.line("estop reset")
    assert said[-1] == "The robot may move again; it is paused, until `resume`."
    shell.line("resume")
    shell.line("estop")
    shell.line("estop release")
    shell.line("estop reset")
    assert said[-1] == "The robot may move again."


def test_nothing_is_queued_under_the_emergency_stop(shell: Shell) -> None:
    shell.line("pause")
    shell.line("estop")
    refused = shell.refused
    shell.line("wave")
    assert said[-1].startswith("Not done: The emergency stop is on")
    assert shell.refused == refused + 1
    assert not shell.robot.busy
