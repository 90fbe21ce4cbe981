"""Whatever is asked for, in whatever order, at whatever tick: jobs end once, the body at rest."""

from __future__ import annotations

from collections import Counter

from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from executive.engine.jobs import OVER
from executive.skills.balance import BalanceParams
from executive.skills.navigate import NavigateParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.search import SearchParams
from executive.skills.skill import BODY
from executive.skills.wait import WaitParams
from tests.fakes.rig import PICK, PUT, WAIT, WALK, Rig
from tests.fakes.scripted_skills import FakeSkill, Script

LIMBS = ("legs", "left_arm", "right_arm", "head")
KINDS = (NavigateParams, PickParams, PlaceParams, SearchParams, WaitParams, BalanceParams)
CODES = ("grasp_missed", "no_path", "object_dropped", "hands_full", "walk_stalled", "no_grasp")
limbs = st.sets(st.sampled_from(LIMBS)).map(frozenset)
scripts = st.builds(
    Script,
    steps=st.integers(0, 8),
    code=st.sampled_from([None, None, *CODES]),
    stop_steps=st.integers(0, 6),
    raises=st.sampled_from([False] * 5 + [True]),
    resources=limbs,
)


class Busy:
    """Which skill has which part of the body for which job, as the skills themselves see it.

    What is wrong is noted, not raised: a skill that raises is only one more failure.
    """

    def __init__(self, rig):
        self.rig = rig
        self.owners = {}
        self.jobs = {}
        self.wrong = []

    def watch(self, skill: FakeSkill) -> FakeSkill:
        start, step, stop = skill.start, skill.step, skill.stop

        def started(now_s):
            self.wrong += [f"{limb} has two skills" for limb in skill.resources & set(self.owners)]
            self.owners.update(dict.fromkeys(skill.resources, skill))
            self.jobs[id(skill)] = self.rig.stage.scope.number
            start(now_s)

        def judged(call):
            def called(now_s):
                if id(skill) not in self.jobs:
                    self.wrong.append("a skill is called that is over")
                report = call(now_s)
                if report.status != "running":
                    self.jobs.pop(id(skill), None)
                    self.owners = {k: v for k, v in self.owners.items() if v is not skill}
                return report

            return called

        skill.start, skill.step, skill.stop = started, judged(step), judged(stop)
        return skill


class JobsMachine(RuleBasedStateMachine):
    """An operator who presses every button."""

    @initialize(lives=st.fixed_dictionaries({k: st.lists(scripts, min_size=1, max_size=3)
                                             for k in KINDS}))  # fmt: skip
    def begin(self, lives):
        self.rig = Rig(lives)
        self.busy = Busy(self.rig)
        make = self.rig.troupe.make
        self.rig.troupe.make = lambda params, attempt: self.busy.watch(make(params, attempt))
        self.final = {}

    @rule(
        errands=st.lists(st.sampled_from([WALK, PICK, PUT, WAIT]), min_size=1, max_size=3),
        urgent=st.booleans(),
        resources=st.one_of(st.just(BODY), limbs),
    )
    def submit(self, errands, urgent, resources):
        self.rig.submit(*errands, urgent=urgent, resources=resources)

    @rule(ticks=st.integers(1, 12))
    def tick(self, ticks):
        self.rig.tick(ticks)

    @rule()
    def pause(self):
        self.rig.executive.pause()

    @rule()
    def resume(self):
        self.rig.executive.resume()

    @rule()
    def stop(self):
        self.rig.executive.stop("enough")

    @rule(index=st.integers(0, 5))
    def cancel(self, index):
        there = [job.number for job in self.rig.executive.jobs if job.state not in OVER]
        if there:
            self.rig.executive.cancel(there[index % len(there)])

    @rule(index=st.integers(0, 5), place=st.integers(0, 5))
    def move(self, index, place):
        there = [job.number for job in self.rig.executive.jobs if job.state == "waiting"]
        if there:
            self.rig.executive.move(there[index % len(there)], place)

    @rule(pattern=st.sampled_from(["pick", "w*", "nothing"]))
    def break_at(self, pattern):
        self.rig.executive.break_at(pattern)

    @rule()
    def step_once(self):
        self.rig.executive.step_once()

    @rule()
    def go_on(self):
        self.rig.executive.clear_breaks()
        self.rig.executive.go_on()

    @invariant()
    def a_final_state_is_final(self):
        if not hasattr(self, "rig"):
            return
        for job in self.rig.executive.jobs:
            assert self.final.setdefault(job.number, job) == job or job.number not in self.over()
        self.final = {job.number: job for job in self.rig.executive.jobs}
        assert not self.busy.wrong
        assert not self.over() & set(self.busy.jobs.values()), "over before its skills rest"

    def over(self):
        return {number for number, job in self.final.items() if job.state in OVER}

    @invariant()
    def a_paused_robot_is_at_rest(self):
        if hasattr(self, "rig") and self.rig.executive.state == "paused":
            assert not self.busy.owners

    def teardown(self):
        if not hasattr(self, "rig"):
            return
        rig = self.rig
        self.go_on()
        rig.executive.resume()
        for _ in range(8000):
            rig.tick()
            if rig.executive.state == "idle":
                break
        assert rig.executive.state == "idle"
        assert rig.stage.quiet
        assert not self.busy.jobs
        assert not self.busy.wrong
        jobs = rig.executive.jobs
        assert all(job.state in OVER for job in jobs)
        told = Counter(e.data["job"] for e in rig.journal.recent
                       if e.event == "job" and e.data["state"] in OVER)  # fmt: skip
        done = Counter((e.data["job"], e.data["id"]) for e in rig.journal.recent
                       if e.event == "done" and "job" in e.data)  # fmt: skip
        if len(rig.journal.recent) < rig.journal.recent.maxlen:
            assert told == {job.number: 1 for job in jobs}
            assert all(count == 1 for count in done.values()), done


JobsMachine.TestCase.settings = settings(max_examples=40, stateful_step_count=20, deadline=None)
TestJobs = JobsMachine.TestCase


@settings(max_examples=40, deadline=None)
@given(
    stop_steps=st.integers(0, 12),
    at=st.lists(st.integers(0, 60), min_size=1, max_size=6, unique=True).map(sorted),
    urgent=st.sets(st.integers(0, 5)),
)
def test_interrupted_at_any_ticks_the_same_steps_are_done_in_the_same_order(stop_steps, at, urgent):
    life = [Script(steps=8, stop_steps=stop_steps)]
    rig = Rig(dict.fromkeys(KINDS, life))
    rig.begin(WALK, PICK, PUT, WAIT)
    for index, tick in enumerate(at):
        rig.tick(max(0, tick - round(rig.now_s / 0.05)))
        if index in urgent:
            rig.submit(WAIT, urgent=True)
        else:
            rig.executive.pause()
            rig.tick(3)
            rig.executive.resume()
    assert rig.run() is True
    done = [
        e.data["step"] for e in rig.journal.recent if e.event == "done" and e.data.get("job") == 1
    ]
    assert done == ["walk", "pick", "put", "wait"]
