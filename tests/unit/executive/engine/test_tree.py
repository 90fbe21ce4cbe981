"""The tree as tables of ticks: fake skills with scripted outcomes, injected time."""

from __future__ import annotations

import json

import pytest

from executive.behaviours.stage import STOP_TIMEOUT_S
from executive.blackboard import ABORT, FAILURE, HEALTH, RECOVERIES
from executive.journal.journal import Journal
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.skills.stop import StopParams
from executive.skills.wait import WaitParams
from executive.trees.build import build
from executive.trees.parts import Branch
from executive.trees.recovery import PER_STEP, PER_TASK, RULES, Errand
from executive.trees.remedies import REMEDIES
from robot.failures import CATALOGUE, Failure
from robot.messages import LidarScan
from tests.fakes.rig import PICK, PUT, TICK_S, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script


def test_steps_are_done_in_order_and_each_once():
    rig = Rig({NavigateParams: [Script(steps=3)], PickParams: [Script(steps=2)]})
    assert rig.begin(WALK, PICK, WAIT).run() is True
    assert rig.troupe.names() == ["navigate", "pick", "wait"]
    assert rig.events("step", "done") == [
        "step walk", "done walk", "step pick", "done pick", "step wait", "done wait",
    ]  # fmt: skip


def test_a_task_that_is_over_is_not_begun_again():
    rig = Rig().begin(WALK)
    rig.run()
    rig.tick(20)
    assert rig.troupe.names() == ["navigate"]


def test_a_failure_without_a_remedy_ends_the_task_with_its_code():
    rig = Rig({PickParams: [Script(steps=1, code="hands_full")]})
    verdict = rig.begin(WALK, PICK, WAIT).run()
    assert isinstance(verdict, Failure)
    assert verdict.code == "hands_full"
    assert rig.troupe.names() == ["navigate", "pick"]


def test_a_missed_grasp_is_looked_for_twice_then_tried_from_elsewhere_then_help_is_asked():
    rig = Rig({PickParams: [Script(code="grasp_missed"), Script()]})
    assert rig.begin(PICK, WAIT).run() is True
    assert rig.troupe.names() == ["pick", "search", "pick", "wait"]
    assert [skill.attempt for skill in rig.troupe.made] == [0, 1, 1, 0]

    rig = Rig({PickParams: [Script(code="grasp_missed")]})
    verdict = rig.begin(PICK).run()
    assert verdict.code == "grasp_missed"
    looked = ["pick", "search", "pick", "search", "pick"]
    assert rig.troupe.names() == [*looked, "navigate", "search", "pick"]
    assert rig.events("help", "answer") == ["help", "answer"]  # nobody was there


def test_what_is_dropped_on_the_way_is_fetched_again():
    rig = Rig({PlaceParams: [Script(steps=2, code="object_dropped"), Script()]})
    assert rig.begin(PUT).run() is True
    assert rig.troupe.names() == ["place", "search", "pick", "place"]


def test_a_remedy_that_fails_is_recovered_from_within_the_same_budget():
    rig = Rig(
        {
            PickParams: [Script(code="grasp_missed"), Script(code="out_of_reach"), Script()],
            SearchParams: [Script(code="object_not_seen"), Script()],
        }
    )
    assert rig.begin(PICK).run() is True
    assert rig.board.read(RECOVERIES) == 3
    assert rig.troupe.names()[-1] == "pick"


@pytest.mark.parametrize("code", sorted(CATALOGUE))
def test_every_code_has_a_rule_and_a_finite_number_of_tries(code):
    rule = RULES[code]
    assert {remedy for remedy, _ in rule.tries} <= set(REMEDIES)
    assert rule.times <= PER_STEP
    # Whatever is asked of the robot, if all of it goes on failing like that, it ends with the code.
    kinds = (PickParams, PlaceParams, NavigateParams, SearchParams)
    rig = Rig({kind: [Script(code=code)] for kind in kinds})
    for errand in (PICK, PUT, WALK):
        verdict = rig.begin(errand).run(400)
        assert verdict.code == code
        assert rig.board.read(RECOVERIES) <= min(PER_STEP, PER_TASK)


def test_there_is_no_rule_for_a_code_that_does_not_exist():
    assert set(RULES) == set(CATALOGUE)


def test_all_codes_in_turn_stay_inside_the_budget_of_the_task():
    turns = [Script(code=code) for code in sorted(CATALOGUE) if RULES[code].times]
    rig = Rig({PickParams: turns, NavigateParams: turns[:], SearchParams: [Script()]})
    rig.begin(*[PICK] * 10).run()
    assert rig.board.read(RECOVERIES) <= PER_TASK


def test_a_skill_that_breaks_is_stopped_and_fails_as_internal():
    rig = Rig({NavigateParams: [Script(raises=True, stop_steps=3)]})
    verdict = rig.begin(WALK).run()
    assert verdict.code == "internal"
    assert "RuntimeError" in verdict.cause
    assert rig.troupe.made[0].calls.count("stop") == 4


def test_a_step_that_takes_too_long_is_stopped():
    rig = Rig({NavigateParams: [Script(steps=10**9, stop_steps=5)]})
    verdict = rig.begin(WALK).run(20_000)
    assert verdict.code == "timeout"
    assert rig.troupe.names() == ["navigate", "navigate"]


def test_the_next_step_waits_until_an_interrupted_one_has_given_the_legs_back():
    rig = Rig({NavigateParams: [Script(steps=10**9, stop_steps=30)]})
    rig.begin(WALK).tick(5)
    rig.executive.cancel(1)
    rig.begin(WAIT)  # a wait that needs the legs too, in this fake
    rig.tick(10)
    assert rig.troupe.names() == ["navigate", "wait"]
    assert rig.troupe.made[1].calls == []
    assert rig.run() is True
    assert rig.troupe.made[0].calls.count("stop") == 31


def test_stop_brings_the_body_to_rest_before_the_task_is_over():
    rig = Rig({NavigateParams: [Script(steps=10**9, stop_steps=20)], StopParams: [Script(steps=4)]})
    rig.begin(WALK, PICK).tick(10)
    rig.executive.stop("stopped on request")
    rig.tick(10)
    assert rig.executive.outcome is None
    verdict = rig.run()
    assert verdict.code == "cancelled"
    assert verdict.cause == "stopped on request"
    assert rig.troupe.names() == ["navigate", "stop"]
    assert rig.troupe.made[1].calls == ["start"] + ["step"] * 5
    assert rig.events("stopping", "stopped", "step")[1:] == [
        "stopping walk", "stopped walk", "step come to a stand",
    ]  # fmt: skip


def test_a_skill_that_never_stops_is_given_up():
    rig = Rig({NavigateParams: [Script(steps=10**9, stop_steps=10**9)]})
    rig.begin(WALK).tick(3)
    rig.executive.stop("stopped on request")
    assert rig.run(int(STOP_TIMEOUT_S / TICK_S) + 50).code == "cancelled"


def scan(stamp_s):
    return LidarScan(stamp_s=stamp_s, angle_min_rad=0, angle_step_rad=0.1, ranges_m=())


def test_a_silent_sensor_holds_the_task_which_then_goes_on_where_it_was():
    rig = Rig({PickParams: [Script(steps=60)]}, rates_hz={"sensors/lidar": 10.0})
    rig.begin(WALK, PICK)
    rig.tick(5)
    assert rig.troupe.names() == []  # it waits for the first scan
    for n in range(80):
        if not 10 <= n < 40:
            rig.link.messages["lidar"] = scan(rig.now_s)
        rig.tick()
    rig.link.messages["lidar"] = scan(1e6)
    assert rig.run() is True
    assert rig.troupe.names() == ["navigate", "pick", "pick"]
    assert rig.troupe.made[1].calls.count("stop") == 1
    assert rig.events("hold") == ["hold", "hold"]


def test_a_sensor_that_stays_silent_ends_the_task():
    rig = Rig(rates_hz={"sensors/lidar": 10.0})
    rig.link.messages["lidar"] = scan(0.0)
    rig.begin(Errand(name="wait", params=WaitParams(duration_s=100.0)))
    rig.troupe.scripts[WaitParams] = [Script(steps=10**9)]
    verdict = rig.run()
    assert verdict.code == "sensor_silent"
    assert 19.0 < rig.now_s < 23.0


def test_a_lost_controller_ends_the_task():
    rig = Rig(rates_hz={"body/state": 50.0})
    verdict = rig.begin(WALK).run()
    assert verdict.code == "controller_lost"
    assert rig.board.read(HEALTH).level.name == "SIT"


def test_a_new_task_after_a_stop_begins_afresh():
    rig = Rig({NavigateParams: [Script(steps=10**9)]})
    rig.begin(WALK).tick(3)
    rig.executive.stop("stopped on request")
    rig.run()
    assert rig.begin(WAIT).run() is True
    assert rig.board.read(ABORT) is None
    assert rig.board.read(FAILURE) is None


@pytest.mark.parametrize(("answer", "done"), [(True, ["wait"]), (False, ["pick"])])
def test_a_branch_is_chosen_once_and_a_failing_branch_does_not_try_the_other(answer, done):
    asked = []

    def question(_board):
        asked.append(1)
        return answer

    rig = Rig({PickParams: [Script(steps=2, code="hands_full")]})
    part = Branch(name="if", question=question, then=WAIT, otherwise=PICK)
    rig.executive.submit(lambda stage: build(part, stage), text="if")
    verdict = rig.run()
    assert rig.troupe.names() == done
    assert (verdict is True) == answer
    assert len(asked) == 1


def test_the_same_run_writes_the_same_journal(tmp_path):
    def play(folder):
        scripts = {PickParams: [Script(steps=3, code="grasp_missed"), Script(steps=2)]}
        with Journal(folder) as journal:
            Rig(scripts, journal=journal).begin(WALK, PICK, PUT).run()
        return (folder / "journal.jsonl").read_bytes()

    first, second = play(tmp_path / "a"), play(tmp_path / "b")
    assert first == second
    assert [json.loads(line)["n"] for line in first.splitlines()]
