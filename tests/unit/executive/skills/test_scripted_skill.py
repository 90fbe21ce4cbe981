"""The skill contract: whatever a script does, the report and the body end well."""

import pytest

from executive.skills.forecast import Forecast
from executive.skills.motions.script import Script, give_up
from executive.skills.scripted import ScriptedSkill
from executive.skills.wait import WaitParams
from robot.messages import Stand
from tests.fakes.stage import Stage


class Counting(ScriptedSkill):
    resources = frozenset({"legs"})

    def __init__(self, context, ticks, end=None):
        super().__init__(WaitParams(), context)
        self.ticks, self.end, self.closed = ticks, end, False

    @classmethod
    def forecast(cls, wanted, outlook):
        return Forecast(0.0)

    def script(self) -> Script[None]:
        self.body.phase = "counting"
        try:
            for i in range(self.ticks):
                self.body.progress = i / self.ticks
                yield
            if self.end is not None:
                raise self.end
        finally:
            self.closed = True


@pytest.fixture
def stage():
    return Stage()


def finish(stage, skill, limit=200):
    for _ in range(limit):
        report = skill.step(stage.puppet.time_s)
        if report.status != "running":
            return report
        stage.puppet.tick()
    raise AssertionError("endless")


def test_a_script_that_returns_has_succeeded(stage):
    skill = Counting(stage.context, 3)
    skill.start(0.0)
    report = finish(stage, skill)
    assert report.status == "succeeded"
    assert report.failure is None
    assert skill.step(99.0) is report
    assert skill.stop(99.0) is report
    assert stage.puppet.sent == []


def test_progress_and_phase_are_reported_while_running(stage):
    skill = Counting(stage.context, 4)
    skill.start(0.0)
    reports = [skill.step(0.05 * i) for i in range(4)]
    assert [report.progress for report in reports] == [0.0, 0.25, 0.5, 0.75]
    assert {report.phase for report in reports} == {"counting"}


def test_giving_up_brings_the_body_to_rest_before_the_report(stage):
    skill = Counting(stage.context, 2, give_up("no_path", "walled in"))
    skill.start(0.0)
    report = finish(stage, skill)
    assert report.status == "failed"
    assert report.failure.code == "no_path"
    assert [type(command) for command in stage.puppet.sent] == [Stand]


def test_a_bug_becomes_an_internal_failure(stage):
    skill = Counting(stage.context, 2, ZeroDivisionError("oops"))
    skill.start(0.0)
    report = finish(stage, skill)
    assert report.failure.code == "internal"
    assert "ZeroDivisionError: oops" in report.failure.cause


def test_stop_leaves_the_script_and_stands_once(stage):
    skill = Counting(stage.context, 1000)
    skill.start(0.0)
    skill.step(0.0)
    report = skill.stop(0.0)
    assert skill.closed
    for _ in range(20):
        if report.status != "running":
            break
        stage.puppet.tick()
        report = skill.stop(stage.puppet.time_s)
    assert report.failure.code == "cancelled"
    assert len(stage.commands(Stand)) == 1


def test_stop_before_start_moves_nothing(stage):
    skill = Counting(stage.context, 3)
    report = skill.stop(0.0)
    assert report.failure.code == "cancelled"
    assert stage.puppet.sent == []
    skill.start(0.1)
    assert skill.step(0.1) is report


def test_a_fall_ends_the_skill_at_once(stage):
    from executive.skills.balance import BalanceParams

    assert stage.run(BalanceParams(mode="hold"), until_phase="holding").status == "running"
    stage.puppet.mode = "fallen"
    stage.puppet.tick()
    report = stage.skill.step(stage.puppet.time_s)
    assert report.failure.code == "fallen"


def test_a_silent_body_is_a_failure_not_a_hang(stage):
    from executive.skills.balance import BalanceParams

    stage.run(BalanceParams(mode="hold"), until_phase="holding")
    frozen = stage.puppet.body()
    stage.puppet.body = lambda: frozen
    for _ in range(30):
        stage.puppet.time_s += 0.05
        report = stage.skill.step(stage.puppet.time_s)
    assert report.failure.code == "sensor_silent"
