"""A signal to a prompt that reads a pipe, or to one that listens, is a wish to leave."""

from __future__ import annotations

import itertools
import os
import signal
from collections.abc import Generator
from contextlib import nullcontext
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from executive.frontends.listening import obeying
from executive.frontends.listening.hearing import Block
from executive.frontends.listening.obeying import Conversation
from executive.frontends.listening.options import Listen
from executive.frontends.prompt.cli import status_of
from executive.frontends.prompt.plain import work_off
from executive.frontends.prompt.shell import Shell
from intents.speech.audio import RATE_HZ
from intents.speech.ear import Ear, Spoken
from robot.exit_status import ExitStatus
from tests.fakes.puppet_shell import puppet_shell

LINES = ["walk 1.5 m forward", "walk 1.5 m back", "where are you?", "wave"]
SIGNALS = [signal.SIGTERM, signal.SIGINT, signal.SIGHUP]


@pytest.fixture
def shell(tmp_path) -> Generator[Shell]:
    """It hears signals, and what it says is in `said`."""
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the tests may be run under nohup
    try:
        with puppet_shell(tmp_path, said, world="empty") as made, made.robot.interrupts.listen():
            yield made
    finally:
        signal.signal(signal.SIGHUP, before)
        said.clear()


said: list[str] = []


def signal_while_it_walks(shell: Shell, number: int) -> None:
    """Send one signal, as soon as it walks."""
    sent: list[int] = []

    def look() -> None:
        if not sent and shell.robot.session.runtime.link.body().mode == "walk":
            sent.append(number)
            os.kill(os.getpid(), number)

    shell.robot.session.on_tick(look)


@pytest.mark.parametrize("number", SIGNALS)
def test_no_line_is_done_after_a_signal(shell: Shell, number: int):
    signal_while_it_walks(shell, number)
    assert not work_off(shell, LINES)
    jobs = shell.robot.executive.jobs
    assert [(job.text, job.state) for job in jobs] == [("walk 1.5 m forward", "cancelled")]
    assert said[-1] == "Not done: “walk 1.5 m back”, and what follows it: a signal says to leave"


def test_a_line_that_is_understood_as_the_signal_comes_comes_to_nothing(shell: Shell):
    submit = shell.robot.submit

    def late(*args, **kwargs) -> int:  # the signal comes just before it, and is carried out
        os.kill(os.getpid(), signal.SIGTERM)
        return submit(*args, **kwargs)

    shell.robot.submit = late
    assert not work_off(shell, LINES)
    assert [job.state for job in shell.robot.executive.jobs] == ["cancelled"]


@pytest.mark.parametrize("button", ["stop", "estop"])
def test_no_line_is_done_after_a_stop_from_elsewhere(shell: Shell, button: str):
    told: list[int] = []

    def look() -> None:
        if not told and shell.robot.session.runtime.link.body().mode == "walk":
            told.append(1)
            if button == "stop":
                shell.stop("STOP was pressed on the page")
            else:
                shell.stop_at_once("estop")

    shell.robot.session.on_tick(look)
    assert not work_off(shell, LINES)
    jobs = shell.robot.executive.jobs
    assert [job.text for job in jobs] == ["walk 1.5 m forward"]
    assert (
        said[-1] == "Not done: “walk 1.5 m back”, and what follows it: the robot was told to stop"
    )


def test_a_stop_that_is_a_line_itself_is_about_no_line_after_it(shell: Shell):
    assert work_off(shell, ["say hello", "stop", "say good night"])
    assert [job.state for job in shell.robot.executive.jobs] == ["done", "done"]


def test_nothing_that_a_recording_says_is_done_after_a_stop_from_elsewhere(shell: Shell):
    ear = SimpleNamespace(replying=False, at_work=True, said=lambda _: None)
    talk = Conversation(shell, cast(Ear, ear), recorded=True, confirm=False)
    talk.take(Spoken(kind="sentence", text="say hello"))
    talk.take(Spoken(kind="stop", text="stop"))
    talk.take(Spoken(kind="sentence", text="say good night"))
    shell.stop("STOP was pressed on the page")
    for text in LINES:
        talk.take(Spoken(kind="sentence", text=text))
    assert [job.state for job in shell.robot.executive.jobs] == ["done", "done"]
    assert talk._status() == ExitStatus.FAILED


@pytest.mark.parametrize(("stopped_in_block", "is_done"), [(1, True), (4, False)])
def test_a_stop_while_it_is_recognised_is_about_what_was_said_before_it(
    shell: Shell, monkeypatch, stopped_in_block: int, is_done: bool
):
    """Somebody spoke in the third block; that they had ended was noticed in the fifth."""
    second = np.zeros(RATE_HZ, dtype=np.float32)
    blocks = iter([Block(sound=second)] * 5)
    count = itertools.count(1)

    def push(*_: object, **__: object) -> list[Spoken]:
        number = next(count)
        if number == stopped_in_block:
            shell.stop("in another terminal")
        return [Spoken(kind="sentence", text="say hello", end_s=2.8)] if number == 5 else []

    ear = SimpleNamespace(replying=False, at_work=True, said=lambda _: None, push=push, finish=list)
    monkeypatch.setattr(obeying, "sound", lambda _: nullcontext(blocks))
    talk = Conversation(shell, cast(Ear, ear), recorded=False, confirm=False)
    talk.run(Listen())
    shell.robot.wait()
    assert bool(shell.robot.executive.jobs) is is_done


def test_lines_without_a_signal_are_all_done(shell: Shell):
    assert work_off(shell, ["say hello", "# nothing", "say good night"])
    assert [job.state for job in shell.robot.executive.jobs] == ["done", "done"]


@pytest.mark.parametrize("number", SIGNALS)
def test_nothing_that_is_heard_after_a_signal_is_done(shell: Shell, number: int):
    ear = SimpleNamespace(replying=False, at_work=True, said=lambda _: None)
    talk = Conversation(shell, cast(Ear, ear), recorded=True, confirm=False)
    signal_while_it_walks(shell, number)
    for text in LINES:
        talk.take(Spoken(kind="sentence", text=text))
    assert [job.state for job in shell.robot.executive.jobs] == ["cancelled"]


def test_the_end_of_the_lines_is_nobody_who_leaves(shell: Shell):
    shell.line("walk 1.5 m forward")  # as one that a run before this one had left open
    assert work_off(shell, [])
    assert [job.state for job in shell.robot.executive.jobs] == ["done"]
    assert status_of(shell) == ExitStatus.DONE


def test_a_robot_that_is_paused_hears_the_next_line(shell: Shell):
    assert work_off(shell, ["pause", "say hello", "resume"])
    assert [job.state for job in shell.robot.executive.jobs] == ["done"]


def test_what_nobody_lets_go_on_is_not_done(shell: Shell):
    assert work_off(shell, ["pause", "say hello"])
    assert [job.state for job in shell.robot.executive.jobs] == ["waiting"]
    assert status_of(shell) == ExitStatus.FAILED
