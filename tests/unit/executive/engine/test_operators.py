"""What an operator does step by step: breakpoints, and answers to what the robot asks."""

from __future__ import annotations

import pytest

from executive.behaviours.ask import ALONE_S, PATIENCE_S, AskForHelp, answer_of
from executive.behaviours.run_skill import RunSkill
from executive.blackboard import HELP
from executive.engine.job_book import JobError
from executive.journal.words import sentence
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.trees.idioms import Alternatives, in_order
from robot.messages import Heard
from tests.fakes.rig import PICK, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

# --- breakpoints --------------------------------------------------------------------------------


def test_a_breakpoint_holds_before_the_step_begins():
    rig = Rig({NavigateParams: [Script(steps=3)]})
    rig.executive.break_at("pi*")
    rig.begin(WALK, PICK, WAIT).tick(30)
    assert rig.troupe.names() == ["navigate"]
    assert rig.executive.held == ("pick",)
    assert rig.executive.state == "paused"
    rig.executive.go_on()
    assert rig.run() is True
    assert rig.events("break") == ["break pick"]


def test_steps_can_be_taken_one_by_one():
    rig = Rig()
    rig.executive.step_once()
    rig.begin(WALK, PICK, WAIT)
    for count in range(3):
        rig.tick(5)
        assert len(rig.troupe.names()) == count
        rig.executive.step_once()
    assert rig.run() is True


def test_a_held_job_can_be_stopped_and_the_next_is_not_held():
    rig = Rig()
    rig.executive.step_once()
    rig.begin(WALK, PICK).tick(5)
    rig.executive.stop("enough")
    assert rig.run().code == "cancelled"
    assert rig.executive.held == ()
    assert rig.begin(WALK).run() is True


# --- help ---------------------------------------------------------------------------------------


def asking(rig):
    """A job that fails with a code, asks for help, and does the step once more."""

    def build(stage):
        node = Alternatives("pick", RunSkill("pick", PICK.params, stage=stage))
        ask = AskForHelp("please hand me the cup", stage=stage)
        node.add_child(in_order("help", [ask, RunSkill("pick", PICK.params, stage=stage)]))
        return node

    rig.executive.submit(build, text="ask")
    return rig


def test_help_is_asked_for_and_the_job_goes_on_when_it_came():
    rig = asking(Rig({PickParams: [Script(code="no_grasp"), Script()]}))
    rig.executive.attended = True
    rig.tick(100)
    assert rig.executive.question == "please hand me the cup"
    rig.executive.answer("continue")
    assert rig.run() is True
    assert rig.board.read(HELP) == ""
    assert rig.events("help", "answer") == ["help", "answer"]


def test_people_who_stand_near_hear_the_question_and_may_answer_it():
    rig = asking(Rig({PickParams: [Script(code="no_grasp"), Script()]}))
    rig.tick(10)
    assert rig.link.spoken == ["please hand me the cup"]
    rig.link.says = [Heard(stamp_s=rig.now_s, text="what?", person_id="ann")]
    rig.tick(2)
    assert rig.executive.question, "that was no answer"
    rig.link.says = [Heard(stamp_s=rig.now_s, text="continue", person_id="ann")]
    assert rig.run() is True
    assert rig.events("heard", "answer") == ["heard", "heard", "answer"]
    told = [data for _, kind, data in rig.at("heard")]
    assert all(data["simulated"] and data["who"] == "ann" for data in told)
    assert "who is simulated" in sentence("heard", told[0])


def test_what_people_say_when_nothing_was_asked_is_only_noted():
    rig = Rig()
    rig.begin(WALK)
    rig.link.says = [Heard(stamp_s=0.0, text="give up", person_id="ann")]
    assert rig.run() is True
    assert rig.events("heard", "answer") == ["heard"]


@pytest.mark.parametrize(("attended", "limit_s"), [(False, ALONE_S), (True, PATIENCE_S)])
def test_without_help_the_job_fails_with_its_own_code_after_a_while(attended, limit_s):
    rig = asking(Rig({PickParams: [Script(code="no_grasp")]}))
    rig.executive.attended = attended
    assert rig.run(10_000).code == "no_grasp"
    assert rig.now_s == pytest.approx(limit_s, abs=0.3)


def test_an_operator_may_give_up():
    rig = asking(Rig({PickParams: [Script(code="no_grasp")]}))
    rig.executive.attended = True
    rig.tick(10)
    with pytest.raises(JobError, match="say continue or give up"):
        rig.executive.answer("perhaps")
    rig.executive.answer("give up")
    assert rig.run().code == "no_grasp"
    with pytest.raises(JobError, match="nothing was asked"):
        rig.executive.answer("continue")


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("continue", "continue"), ("Continue.", "continue"), ("yes", "continue"),
        ("ok", "continue"), ("sure, go ahead", "continue"), ("yes please", "continue"),
        ("give up", "give up"), ("no", "give up"), ("no, thanks", "give up"),
        ("wave", None), ("what?", None), ("yes, and wave", None),
    ],
)  # fmt: skip
def test_a_yes_or_no_answers_what_the_robot_asks_for(line, answer):
    assert answer_of(line) == answer
