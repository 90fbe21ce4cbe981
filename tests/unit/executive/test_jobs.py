"""Jobs as tables of ticks: queue, pause, preempt, cancel, stop, breakpoints, help."""

from __future__ import annotations

import pytest

from executive.app import JobError
from executive.behaviours.ask import ALONE_S, PATIENCE_S, AskForHelp
from executive.behaviours.conditions import Check
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.stage import STOP_TIMEOUT_S
from executive.blackboard import HELP
from executive.jobs import Job, Limits, side_by_side
from executive.skills.parameters import (
    LookParams,
    NavigateParams,
    PickParams,
    SayParams,
    SearchParams,
    StopParams,
    WaitParams,
)
from executive.trees.idioms import Alternatives, in_order
from executive.trees.recovery import Errand
from robot.messages import LidarScan
from tests.fakes.rig import PICK, TICK_S, WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script

LONG = 10**9
LOOK = Errand(name="look", params=LookParams(object_id="cup"))
SAY = Errand(name="speak", params=SayParams(text="hello"))
LEGS, HEAD, VOICE = (frozenset({part}) for part in ("legs", "head", "voice"))
HEADED = [Script(steps=3, resources=HEAD)]


def states(rig):
    return {job.number: job.state for job in rig.executive.jobs}


def at(rig, *kinds):
    return [(event.t_s, event.event, event.data) for event in rig.journal.recent
            if event.event in kinds]  # fmt: skip


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
    assert states(rig) == {1: "running", 2: "running"}
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
    assert states(rig) == {1: "running", 2: "waiting", 3: "waiting", 4: "waiting"}
    rig.executive.move(4, 0)
    rig.executive.drop(2)
    rig.tick()
    assert [job.number for job in rig.executive.jobs] == [2, 1, 4, 3]
    rig.run()
    began = sorted(
        (job.began_s, job.number) for job in rig.executive.jobs if job.began_s is not None
    )
    assert [number for _, number in began] == [1, 4, 3]
    assert states(rig)[2] == "cancelled"


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
    assert states(rig) == {1: "interrupted", 2: "running"}
    assert rig.run() is True
    assert rig.troupe.names() == ["navigate", "pick", "wait", "pick"]
    assert rig.events("done") == ["done walk", "done wait", "done pick"]
    again = [data.get("resumed") for _, _, data in at(rig, "step")]
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
    assert states(rig) == {1: "interrupted", 2: "interrupted", 3: "running"}
    rig.run()
    over = [data["job"] for _, _, data in at(rig, "job") if data["state"] == "done"]
    assert over == [3, 2, 1]


# --- pause --------------------------------------------------------------------------------------


def test_a_pause_is_one_only_when_the_body_stands():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=10)]})
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(10)
    assert rig.executive.state == "pausing"
    rig.tick(5)
    assert rig.executive.state == "paused"
    assert states(rig) == {1: "paused"}
    assert rig.troupe.names() == ["navigate", "stop"]
    rig.tick(100)
    assert rig.troupe.names() == ["navigate", "stop"]
    rig.executive.resume()
    rig.tick(2)
    assert rig.executive.state == "working"
    assert rig.troupe.names() == ["navigate", "stop", "navigate"]


def test_a_pause_in_a_recovery_goes_on_with_the_same_try():
    rig = Rig(
        {
            PickParams: [Script(code="grasp_missed"), Script(steps=10), Script(steps=10)],
            SearchParams: [Script(steps=10)],
        }
    )
    rig.begin(PICK).tick(5)
    assert rig.troupe.names() == ["pick", "search"]
    rig.executive.pause()
    rig.tick(5)
    rig.executive.resume()
    rig.tick(15)
    rig.executive.pause()
    rig.tick(5)
    rig.executive.resume()
    assert rig.run() is True
    names = [name for name in rig.troupe.names() if name != "stop"]
    assert names == ["pick", "search", "search", "pick", "pick"]
    attempts = [skill.attempt for skill in rig.troupe.made if isinstance(skill.params, PickParams)]
    assert attempts == [0, 1, 1]
    assert rig.executive.outcome.recoveries == 1


def test_pausing_twice_and_resuming_twice_is_once():
    rig = Rig({NavigateParams: [Script(steps=10)]})
    rig.begin(WALK).tick(3)
    for _ in range(2):
        rig.executive.pause()
        rig.tick(4)
    for _ in range(2):
        rig.executive.resume()
        rig.tick(1)
    assert rig.run() is True
    assert len(at(rig, "pause")) == len(at(rig, "resume")) == 1


def test_resuming_before_the_body_stands_waits_for_it():
    rig = Rig({NavigateParams: [Script(steps=5, stop_steps=20)]})
    rig.begin(WALK).tick(3)
    rig.executive.pause()
    rig.tick(3)
    rig.executive.resume()
    assert rig.run() is True
    first, second = (skill for skill in rig.troupe.made if skill.calls)
    assert first.calls.count("stop") == 21
    assert second.calls.count("step") == 6


def test_paused_time_is_no_part_of_a_step_or_of_a_jobs_limit():
    rig = Rig({NavigateParams: [Script(steps=40)]})
    rig.submit(WALK, limits=Limits(duration_s=5.0))
    rig.tick(3)
    rig.executive.pause()
    rig.tick(6000)
    rig.executive.resume()
    assert rig.run() is True


def test_a_job_that_takes_too_long_ends_with_timeout_and_at_rest():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=8)]})
    rig.submit(WALK, limits=Limits(duration_s=1.0))
    verdict = rig.run()
    assert verdict.code == "timeout"
    assert rig.now_s == pytest.approx(1.0 + 8 * TICK_S, abs=0.16)
    assert rig.stage.quiet


# --- cancel and stop ----------------------------------------------------------------------------


def test_a_cancel_is_complete_only_when_the_body_is_at_rest():
    rig = Rig({NavigateParams: [Script(steps=LONG, stop_steps=15)]})
    rig.begin(WALK, PICK).tick(5)
    rig.executive.cancel(1)
    rig.tick(10)
    assert states(rig) == {1: "running"}
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
    assert states(rig)[3] == "waiting"
    assert rig.run() is True
    assert states(rig) == {1: "cancelled", 2: "cancelled", 3: "done"}
    assert rig.troupe.names() == ["navigate", "stop", "navigate"]


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
    assert states(rig) == {1: "cancelled"}
    assert rig.executive.state == "paused"
    rig.submit(WAIT)
    rig.tick(10)
    assert states(rig)[2] == "waiting"
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
    told = [data["state"] for _, _, data in at(rig, "job")]
    assert told == ["waiting", "running", "paused", "running", "done"]


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


def test_a_paused_robot_does_not_lose_its_jobs_when_a_sensor_falls_silent():
    rig = Rig({NavigateParams: [Script(steps=20)]}, rates_hz={"sensors/lidar": 10.0})
    rig.link.messages["lidar"] = scan(0.0)
    rig.begin(WALK).tick(5)
    rig.executive.pause()
    rig.tick(1000)
    assert rig.executive.state == "paused"
    assert states(rig) == {1: "paused"}
    rig.executive.resume()
    rig.tick(20)
    assert rig.events("hold") == ["hold"]
    rig.link.messages["lidar"] = scan(1e6)
    assert rig.run() is True


def test_a_pause_while_a_sensor_is_silent_is_one_too():
    rig = Rig({NavigateParams: [Script(steps=20)]}, rates_hz={"sensors/lidar": 10.0})
    rig.link.messages["lidar"] = scan(0.0)
    rig.begin(WALK).tick(30)
    assert rig.events("hold") == ["hold"]
    rig.executive.pause()
    rig.tick(10)
    assert rig.executive.state == "paused"


def scan(stamp_s):
    return LidarScan(stamp_s=stamp_s, angle_min_rad=0, angle_step_rad=0.1, ranges_m=())
