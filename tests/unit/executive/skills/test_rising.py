"""Getting up: only who lies does, and what the hands held counts as lost."""

import pytest

from executive.skills.balance import BalanceParams
from robot.messages import Activity, GetUp, Stand
from tests.fakes.puppet import Puppet
from tests.fakes.stage import Stage


@pytest.fixture
def stage():
    return Stage()


def sent(stage, kind):
    return [command for command in stage.puppet.sent if isinstance(command, kind)]


def test_who_lies_gets_up_to_stand(stage):
    stage.puppet.mode = "fallen"
    report = stage.run(BalanceParams(mode="get_up", duration_s=0.5))
    assert report.status == "succeeded"
    assert len(sent(stage, GetUp)) == 1
    assert stage.puppet.mode == "stand"


def test_who_stands_does_not_get_up(stage):
    assert stage.run(BalanceParams(mode="get_up", duration_s=0.5)).status == "succeeded"
    assert sent(stage, GetUp) == []


@pytest.mark.parametrize("mode", ["squat", "stand"])
def test_only_who_is_told_to_leaves_the_floor_and_the_cure_is_named(stage, mode):
    stage.puppet.mode = "fallen"
    report = stage.run(BalanceParams(mode=mode))
    assert report.failure.code == "fallen"
    assert "get up" in report.failure.suggestion
    assert sent(stage, GetUp) == []


def test_a_body_that_does_not_get_up_has_fallen(stage, monkeypatch):
    stage.puppet.mode = "fallen"

    def refuse(puppet, command):
        puppet.sent.append(command)
        puppet._activities["legs"] = Activity(id=command.id, status="failed", detail="it slid")

    monkeypatch.setattr(Puppet, "send", refuse)
    report = stage.run(BalanceParams(mode="get_up"))
    assert report.failure.code == "fallen"
    assert "it slid" in report.failure.cause


def test_a_stop_on_the_way_up_tells_the_body_at_once(stage):
    stage.puppet.mode = "fallen"
    stage.run(BalanceParams(mode="get_up"), until_phase="getting up")
    assert stage.puppet.mode == "rising"
    stage.skill.stop(stage.puppet.time_s)
    assert len(sent(stage, Stand)) == 1  # any command to the legs ends the way up


@pytest.mark.parametrize(("mode", "code"), [("fallen", "fallen"), ("stand", "controller_lost")])
def test_a_controller_that_dies_on_the_way_up_is_noticed_at_the_next_tick(stage, mode, code):
    """The next controller answers nothing, for it was told nothing."""
    puppet = stage.puppet
    puppet.mode = "fallen"
    stage.run(BalanceParams(mode="get_up"), until_phase="getting up")
    puppet.since_s, puppet.mode = puppet.time_s, mode
    puppet._activities["legs"] = Activity(id=0, status="idle")
    died_s, report = puppet.time_s, None
    while report is None or report.status == "running":
        puppet.tick()
        report = stage.skill.step(puppet.time_s)
        assert report.status == "failed" or report.phase == "coming to rest"
    assert report.failure.code == code
    assert "the controller died while the robot was getting up" in report.failure.cause
    assert report.failure.suggestion
    assert puppet.time_s - died_s < 1.0


def test_a_takeover_before_it_was_told_to_get_up_changes_nothing(stage):
    stage.puppet.mode = "fallen"
    stage.puppet.since_s = 3.0
    assert stage.run(BalanceParams(mode="get_up", duration_s=0.5)).status == "succeeded"
