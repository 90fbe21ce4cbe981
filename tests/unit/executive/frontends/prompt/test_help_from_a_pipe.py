"""Where lines come from a pipe, the next one answers a robot that asks for help, or nobody does."""

from __future__ import annotations

from collections.abc import Generator

import pytest

from executive.frontends.prompt.cli import status_of
from executive.frontends.prompt.plain import work_off
from executive.frontends.prompt.shell import Shell
from robot.exit_status import ExitStatus
from tests.fakes.puppet_shell import puppet_shell

ORDER = "find the blue cup"
said: list[str] = []


@pytest.fixture
def shell(tmp_path) -> Generator[Shell]:
    with puppet_shell(tmp_path, said, kind="fast") as made:
        yield made
    said.clear()


def asked(shell: Shell) -> list[str]:
    return [event.data["answer"] for event in shell.robot.session.journal.recent
            if event.event == "answer"]  # fmt: skip


def test_at_the_end_of_the_lines_it_is_given_up(shell: Shell):
    assert work_off(shell, [ORDER])
    assert [job.state for job in shell.robot.executive.jobs] == ["failed"]
    assert asked(shell) == ["give up"]
    assert said[-1] == "Nobody answers, so I give up."
    assert status_of(shell) == ExitStatus.FAILED


def test_a_line_about_something_else_is_done_after_it_is_given_up(shell: Shell):
    assert work_off(shell, [ORDER, "where are you?", "wave"])
    jobs = shell.robot.executive.jobs
    assert [(job.text, job.state) for job in jobs] == [(ORDER, "failed"), ("wave", "done")]
    assert said.index("Nobody answers, so I give up.") < said.index("> wave")


@pytest.mark.parametrize(("line", "answer"), [("continue", "continue"), ("no", "give up")])
def test_the_next_line_may_be_the_answer(shell: Shell, line: str, answer: str):
    assert work_off(shell, [ORDER, line])
    assert asked(shell)[0] == answer
    assert [job.state for job in shell.robot.executive.jobs] == ["failed"]
