"""Jobs as tables of ticks: who runs, the queue, urgent ones."""

from __future__ import annotations

import pytest

from executive.behaviours.conditions import Check
from executive.behaviours.run_skill import RunSkill
from executive.engine.job_book import JobError
from executive.engine.jobs import Job, Limits, side_by_side
from executive.skills.look import LookParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.wait import WaitParams
from executive.trees.idioms import in_order
from executive.trees.recovery import Errand
from tests.fakes.rig import PICK, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

LONG = 10**9
LOOK = Errand(name="look", params=LookParams(object_id="cup"))
LEGS, HEAD, VOICE = (frozenset({part}) for part in ("legs", "head", "voice"))


# --- who runs -----------------------------------------------------------------------------------


def job(number, resources, *, urgent=False, begun=False):
    return Job(
        number=number, text="", resources=resources, urgent=urgent, began_s=0.0 if begun else None
    )


@pytest.mark.parametrize(
    ("jobs", "running"),
    [
        ([job(1, LEGS), job(2, LEGS)], [1]),
        ([job(1, LEGS), job(2, HEAD)], [1, 2]),
        ([job(1, LEGS), job(2, LEGS | HEAD), job(3, HEAD)], [1]),  # 3 must not overtake 2
        ([job(1, LEGS, begun=True), job(2, LEGS, urgent=True)], [2]),
        ([job(1, LEGS, begun=True), job(2, HEAD, urgent=True)], [2, 1]),
        ([job(1, LEGS, urgent=True), job(2, LEGS, urgent=True)], [2]),
        ([job(3, LEGS), job(1, LEGS, begun=True)], [1]),
        ([job(1, frozenset()), job(2, frozenset()), job(3, LEGS)], [1, 2, 3]),
        ([], []),
    ],
)
def test_who_runs_side_by_side(jobs, running):
    assert [job.number for job in side_by_side(jobs)] == running


def test_jobs_that_share_nothing_run_side_by_side_and_fail_apart():
    rig = Rig({NavigateParams: [Script(steps=20)], LookParams: [Script(steps=3, resources=HEAD,
               code="unknown_place")]})  # fmt: skip
    rig.submit(WALK, resources=LEGS)
    rig.submit(LOOK, resources=HEAD)
    rig.tick(3)
    assert rig.states == {1: "running", 2: "running"}
    rig.run()
    jobs = {job.number: job for job in rig.executive.jobs}
    assert jobs[1].state == "done"
    assert jobs[1].failure is None
    assert jobs[2].state == "failed"
    assert jobs[2].failure.code == "unknown_place"
    assert jobs[2].took_s < jobs[1].took_s


def test_the_queue_is_worked_off_in_order_and_can_be_changed():
    rig = Rig({NavigateParams: [Script(steps=5)]})
    for _ in range(4):
        rig.submit(WALK)
    rig.tick()
    assert rig.states == {1: "running", 2: "waiting", 3: "waiting", 4: "waiting"}
    rig.executive.move(4, 0)
    rig.executive.drop(2)
    rig.tick()
    assert [job.number for job in rig.executive.jobs] == [2, 1, 4, 3]
    rig.run()
    began = sorted(
        (job.began_s, job.number) for job in rig.executive.jobs if job.began_s is not None
    )
    assert [number for _, number in began] == [1, 4, 3]
    assert rig.states[2] == "cancelled"


def test_requests_for_jobs_that_are_not_there_are_refused():
    rig = Rig({NavigateParams: [Script(steps=5)]})
    rig.submit(WALK)
    with pytest.raises(JobError, match="no job 7; there is: 1"):
        rig.executive.cancel(7)
    rig.tick()
    with pytest.raises(JobError, match="no waiting job 1; there is: none"):
        rig.executive.move(1, 0)
    rig.run()
    with pytest.raises(JobError):
        rig.executive.drop(1)


def test_a_mistake_in_one_jobs_tree_ends_that_job_only():
    def wrong(_board):
        raise KeyError("a bug")

    rig = Rig({NavigateParams: [Script(steps=20)]})
    rig.submit(WALK, resources=LEGS)
    rig.executive.submit(
        lambda stage: in_order("task", [
            RunSkill("wait", WAIT.params, stage=stage), Check("?", wrong, board=stage.board)
        ]),
        text="broken",
        resources=HEAD,
    )  # fmt: skip
    rig.run()
    jobs = {job.number: job for job in rig.executive.jobs}
    assert jobs[1].state == "done"
    assert jobs[2].failure.code == "internal"
    assert rig.stage.quiet


# --- urgent -------------------------------------------------------------------------------------


def test_an_urgent_job_interrupts_and_the_other_comes_back_at_its_step():
    kinds = (NavigateParams, PickParams, WaitParams)
    rig = Rig({kind: [Script(steps=20, stop_steps=6)] for kind in kinds})
    rig.begin(WALK, PICK)
    rig.tick(30)
    assert rig.troupe.names() == ["navigate", "pick"]
    rig.submit(WAIT, urgent=True)
    rig.tick(2)
    assert rig.states == {1: "interrupted", 2: "running"}
    assert rig.run() is True
    assert rig.troupe.names() == ["navigate", "pick", "wait", "pick"]
    assert rig.events("done") == ["done walk", "done wait", "done pick"]
    again = [data.get("resumed") for _, _, data in rig.at("step")]
    assert again == [None, None, None, True]


def test_an_urgent_job_begins_only_when_the_legs_are_at_rest():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=12)]})
    rig.begin(WALK).tick(5)
    rig.submit(WAIT, urgent=True)
    rig.tick(13)
    walk, wait = rig.troupe.made
    assert walk.calls.count("stop") == 13
    assert wait.calls[:2] == ["start", "step"]


def test_urgent_jobs_stack():
    kinds = (NavigateParams, WaitParams, PickParams)
    rig = Rig({kind: [Script(steps=20)] for kind in kinds})
    rig.submit(WALK)
    rig.tick(3)
    rig.submit(WAIT, urgent=True)
    rig.tick(3)
    rig.submit(PICK, urgent=True)
    rig.tick(1)
    assert rig.states == {1: "interrupted", 2: "interrupted", 3: "running"}
    rig.run()
    over = [data["job"] for _, _, data in rig.at("job") if data["state"] == "done"]
    assert over == [3, 2, 1]


# --- speed --------------------------------------------------------------------------------------


def test_a_jobs_speed_limit_holds_while_the_job_has_its_turn():
    rig = Rig()
    seen = {}

    class Probe:
        resources = frozenset()

        def __init__(self, name):
            self.name = name

        def start(self, now_s):
            pass

        def step(self, now_s):
            from executive.skills.skill import SkillReport

            seen[self.name] = rig.executive._context.speed_limit()
            return SkillReport(status="succeeded")

    rig.executive._make = lambda params, given: Probe(type(params).__name__)
    rig.submit(WALK, resources=LEGS, limits=Limits(speed_m_s=0.2))
    rig.submit(WAIT, resources=HEAD)
    rig.run()
    assert seen == {"NavigateParams": 0.2, "WaitParams": float("inf")}
