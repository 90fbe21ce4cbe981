"""Cries at the prompt: they halt what is under way, and a word lets it go on or ends it."""

from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from prompt_toolkit.buffer import Buffer
from prompt_toolkit.keys import Keys

from executive.frontends.listening.obeying import Conversation
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.terminal import Terminal
from executive.frontends.speaking import Speech
from intents.speech.ear import Ear, Spoken
from tests.fakes.voices import Loudspeaker
from tests.fakes.waiting import eventually


def test_ctrl_c_silences_a_robot_that_stands_and_speaks(shell: Shell):
    voice = Loudspeaker()
    shell.speech = Speech(voice)
    try:
        terminal = Terminal(shell, history=None)
        (ctrl_c,) = terminal._keys().get_bindings_for_keys((Keys.ControlC,))
        line = Buffer()
        layout = SimpleNamespace(is_searching=False)
        app = SimpleNamespace(layout=layout, current_buffer=line, quoted_insert=False)
        ctrl_c.handler(SimpleNamespace(app=app, current_buffer=line))
        assert voice.told == ["(hush)"]
    finally:
        shell.speech = Speech()


def test_ctrl_c_closes_an_open_question(shell: Shell, tmp_path: Path):
    shell.line("pick up the cup")
    assert shell.dialogue.question is not None
    terminal = Terminal(shell, history=None)
    assert terminal._stop_busy()
    assert shell.dialogue.question is None
    assert "I ask no more." in shell.out.text
    before = len(shell.robot.executive.jobs)
    shell.line("red")
    assert len(shell.robot.executive.jobs) == before
    assert not terminal._stop_busy()


def test_a_wish_to_stay_stops_what_is_under_way_and_is_a_task_otherwise(shell: Shell):
    shell.line("walk 1 metre forward")
    assert shell.robot.busy
    shell.line("stand still")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "cancelled"
    shell.line("stand still")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].text == "stand still"
    assert shell.robot.executive.jobs[-1].state == "done"
    shell.line("walk 1 metre back")
    shell.robot.wait()


def test_a_cry_halts_what_is_under_way_and_asks_whether_to_go_on(shell: Shell):
    shell.line("walk 1 metre forward")
    shell.line("careful!")
    assert "Shall I go on with “walk 1 metre forward”?" in shell.out.text
    assert eventually(lambda: shell.robot.executive.state == "paused")
    shell.line("where are you?")
    assert "Still open: Shall I go on" in shell.out.text
    shell.line("yes")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "done"
    shell.line("walk 1 metre back")
    shell.line("not that")
    shell.line("no")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "cancelled"
    assert shell.dialogue.question is None
    assert not shell.brake.halt.on
    shell.line("wave")
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "done"


@pytest.mark.parametrize("cry", ["wait", "pause", "cancel", "careful"])
def test_a_cry_that_was_heard_by_mistake_costs_a_question(shell: Shell, cry: str):
    ear = SimpleNamespace(replying=False, at_work=True, said=lambda _: None)
    talk = Conversation(shell, cast(Ear, ear), recorded=False, confirm=False)
    heard = partial(Spoken, text=cry)
    shell.line("squat for 2 seconds")
    talk.take(heard(kind="halt"))
    assert eventually(lambda: shell.robot.executive.state == "paused")
    talk.take(heard(kind="halted"))
    assert eventually(lambda: ear.replying)
    assert "Shall I go on with “squat for 2 seconds”?" in shell.out.text
    talk.take(Spoken(kind="sentence", text="yes"))  # which is done beside
    assert eventually(lambda: shell.robot.executive.jobs[-1].state == "done")


def test_a_pause_that_is_said_waits_for_a_yes(shell: Shell):
    ear = SimpleNamespace(replying=False, at_work=True, said=lambda _: None)
    talk = Conversation(shell, cast(Ear, ear), recorded=False, confirm=False)
    shell.line("squat for 60 seconds")
    talk.take(Spoken(kind="sentence", text="pause"))
    assert eventually(lambda: ear.replying)
    assert eventually(lambda: shell.robot.executive.state in ("pausing", "paused"))
    talk.take(Spoken(kind="stop", text="stop"))
    shell.robot.wait()
    assert shell.robot.executive.jobs[-1].state == "cancelled"
    assert shell.dialogue.question is None


def test_what_is_said_after_a_cry_takes_the_place_of_what_was_halted(shell: Shell):
    shell.line("walk 1 metre forward")
    shell.line("hold on")
    shell.line("say good morning")
    assert "Instead of “walk 1 metre forward”." in shell.out.text
    shell.robot.wait()
    assert [job.state for job in shell.robot.executive.jobs[-2:]] == ["cancelled", "done"]


def test_a_correction_takes_the_place_of_what_it_corrects(shell: Shell):
    shell.line("break look*")  # so that it is at it still, however soon it would see the cup
    shell.line("say good morning and look at the red cup")
    shell.line("no, the blue one")
    shell.line("break off")
    shell.robot.wait()
    before, after = shell.robot.executive.jobs[-2:]
    assert before.state == "cancelled"
    assert "blue cup" in after.text
    assert after.state == "done"


def test_to_a_robot_that_stands_a_warning_is_answered_with_what_is_true(shell: Shell):
    shell.line("stop")  # whatever went on before
    shell.robot.wait()
    before = len(shell.robot.executive.jobs)
    for line in ("careful!", "watch out", "not that"):
        shell.line(line)
        assert shell.out[-1] == "I stand already."
        assert shell.dialogue.question is None
    assert len(shell.robot.executive.jobs) == before


def test_no_to_a_question_is_no_cry(shell: Shell):
    shell.line("walk 1 metre back")
    shell.line("pick up the cup")
    shell.line("no")
    assert not shell.brake.halt.on
    shell.line("stop")
    shell.robot.wait()
