"""What is left of a skill that is interrupted: what was done is not done again."""

from __future__ import annotations

import pytest

from executive.skills.balance import BalanceParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.say import SayParams
from executive.skills.skill import Resumable
from executive.skills.wait import WaitParams
from tests.fakes.stage import Stage

ON_COUNTER = PlaceParams(object_id="cup", place_id="counter")


def interrupted(stage, params, *, ticks, until_phase=None):
    """Run a skill for some ticks (from a phase on); what is left of it, once it is at rest."""
    if until_phase is None:
        stage.skill = stage.make(params)
    else:
        assert stage.run(params, until_phase=until_phase).status == "running"
    for _ in range(ticks):
        stage.puppet.tick()
        assert stage.skill.step(stage.puppet.time_s).status == "running"
    assert isinstance(stage.skill, Resumable)
    left = stage.skill.remaining()
    stage.stop()
    return left


@pytest.mark.parametrize("ticks", [0, 1, 20, 39])
def test_of_a_wait_the_time_that_is_left(ticks):
    left = interrupted(Stage(), WaitParams(duration_s=2.0), ticks=ticks)
    assert left.duration_s == pytest.approx(2.0 - max(0, ticks - 1) * 0.05, abs=1e-6)


def test_of_a_wait_for_ever_all_of_it():
    assert interrupted(Stage(), WaitParams(), ticks=9) == WaitParams()


def test_of_a_posture_the_time_that_it_was_not_held_yet():
    squat = BalanceParams(mode="squat", duration_s=3.0)
    assert interrupted(Stage(), squat, ticks=2) == squat
    left = interrupted(Stage(), squat, ticks=20, until_phase="holding")
    assert left.mode == "squat"
    assert left.duration_s == pytest.approx(2.0, abs=0.11)


def test_what_was_said_is_not_said_again():
    stage = Stage()
    assert interrupted(stage, SayParams(text="hello"), ticks=1) is None
    assert stage.said == ["hello"]


@pytest.mark.parametrize("phase", ["letting go", "drawing"])
def test_a_hand_that_lets_go_draws_back_before_it_rests_and_that_was_it(phase):
    stage = Stage()
    assert stage.run(PickParams(object_id="cup")).status == "succeeded"
    assert interrupted(stage, ON_COUNTER, ticks=1, until_phase=phase) is None
    assert stage.puppet.holding == {}
    cup, hand = stage.puppet.things["cup"].X_WO, stage.puppet.X_WS @ stage.puppet._hands["right"]
    assert abs(hand.p[0] - cup.p[0]) > 0.08
    assert stage.puppet.mode == "stand"


def test_before_that_all_of_it_with_the_object_in_the_hand():
    stage = Stage()
    stage.run(PickParams(object_id="cup"))
    assert interrupted(stage, ON_COUNTER, ticks=2, until_phase="lowering") == ON_COUNTER
    assert stage.run(ON_COUNTER).status == "succeeded"
