"""Cancelling and stopping as tables of ticks: over only when the body is at rest."""

from __future__ import annotations

import pytest

from executive.behaviours.stage import STOP_TIMEOUT_S
from executive.skills.navigate import NavigateParams
from executive.skills.stop import StopParams
from tests.fakes.rig import PICK, TICK_S, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

LONG = 10**9


def test_a_cancel_is_complete_only_when_the_body_is_at_rest():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=15)]})
    rig.begin(WALK, PICK).tick(5)
    rig.executive.cancel(1)
    rig.tick(10)
    assert rig.states == {1: "running"}
    assert rig.executive.outcome is None
    assert rig.run().code == "cancelled"
    assert rig.stage.quiet
    assert rig.troupe.names() == ["navigate"]


def test_what_is_submitted_while_stopping_begins_when_the_robot_stands():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=15), Script(steps=2)]})
    rig.submit(WALK)
    rig.submit(PICK)
    rig.tick(5)
    rig.executive.stop("enough")
    rig.tick(3)
    rig.submit(WALK)
    rig.tick(5)
    assert rig.executive.state == "stopping"
    assert rig.states[3] == "waiting"
    assert rig.run() is True
    assert rig.states == {1: "cancelled", 2: "cancelled", 3: "done"}
    assert rig.troupe.names() == ["navigate", "stop", "navigate"]


def test_a_stop_of_what_is_stopping_already_is_told_once():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=15)]})
    rig.begin(WALK).tick(5)
    for _ in range(3):
        rig.executive.stop("the operator leaves")
        rig.tick(2)
    assert rig.run().cause == "the operator leaves"
    told = [event.event for event in rig.stage.journal.recent]
    assert told.count("stop") == 1
    rig.begin(WALK).tick(5)
    rig.executive.stop("the operator leaves")
    rig.run()
    assert [event.event for event in rig.stage.journal.recent].count("stop") == 2


@pytest.mark.parametrize("ticks", [0, 1, 3, 8, 30])
def test_a_stop_while_pausing_or_paused_ends_everything(ticks):
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=5)]})
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(ticks)
    rig.executive.stop("enough")
    assert rig.run().cause == "enough"
    assert rig.stage.quiet
    rig.tick()
    assert rig.executive.state == "idle"
    assert rig.begin(WAIT).run() is True


def test_a_paused_job_can_be_cancelled_and_the_pause_stays():
    rig = Rig({NavigateParams: [Script(steps=LONG)]})
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(10)
    rig.executive.cancel(1)
    rig.tick(2)
    assert rig.states == {1: "cancelled"}
    assert rig.executive.state == "paused"
    rig.submit(WAIT)
    rig.tick(10)
    assert rig.states[2] == "waiting"
    rig.executive.resume()
    assert rig.run() is True


def test_every_job_tells_the_journal_each_of_its_states_once():
    rig = Rig({NavigateParams: [Script(steps=5)]})
    rig.begin(WALK)
    rig.tick(2)
    rig.executive.pause()
    rig.tick(5)
    rig.executive.resume()
    rig.run()
    told = [data["state"] for _, _, data in rig.at("job")]
    assert told == ["waiting", "running", "paused", "running", "done"]


def test_a_job_whose_skill_does_not_rest_is_over_only_when_the_robot_was_brought_to_a_stand():
    lives = {NavigateParams: [Script(steps=LONG, stop_steps=LONG)], StopParams: [Script(steps=6)]}
    rig = Rig(lives)
    rig.begin(WALK).tick(3)
    rig.executive.cancel(1)
    rig.tick(int(STOP_TIMEOUT_S / TICK_S) + 3)
    assert rig.executive.outcome is None
    assert rig.run().code == "cancelled"
    stand = rig.troupe.made[-1]
    assert isinstance(stand.params, StopParams)
    assert stand.calls.count("step") == 7
    rig.troupe.scripts[NavigateParams] = [Script(steps=3)]
    assert rig.begin(WALK).run() is True
