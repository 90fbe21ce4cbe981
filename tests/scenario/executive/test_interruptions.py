"""Real skills on a puppet, interrupted at any tick: nothing is done twice, nothing is left out."""

from __future__ import annotations

from hypothesis import example, given, settings
from hypothesis import strategies as st

from executive.engine.jobs import OVER
from executive.meaning.request import Understood, request
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from executive.trees.parts import errands
from tests.fakes.puppet_runtime import PuppetRuntime
from tests.fakes.worlds import WHERE, puppet

JOB = (
    "walk half a metre forward, then say hello, then pick up the red cup and put it on the table, "
    "then squat for two seconds, then wait one second"
)
URGENT = "turn left, then wait one second"
TICK_S = 0.05


def understood(text) -> Understood:
    outcome = request(text, WHERE)
    assert isinstance(outcome, Understood), outcome
    return outcome


TASKS = {text: understood(text) for text in (JOB, URGENT)}


class Run:
    """The job on a puppet, with things that happen at some ticks."""

    def __init__(self, events):
        self.runtime = PuppetRuntime(puppet())
        self.body = self.runtime.puppet
        self.session = Session(Setup(where=WHERE), Opened(self.runtime, self.runtime.planner))
        self.executive = self.session.executive
        self.ticks = 0
        self.events = sorted(events)
        self.paused_at = None
        self.session.on_tick(self.happen)
        self.kinds = []
        with self.session:
            self.session.submit(TASKS[JOB])
            self.session.run(until=self.over)

    def over(self):
        assert self.ticks < 20_000, "it does not end"
        return self.executive.state == "idle"

    def happen(self):
        self.ticks += 1
        if self.executive.state == "paused":
            self.rests()
            self.executive.resume()
        while self.events and self.events[0][0] <= self.ticks:
            kind = self.events.pop(0)[1]
            self.kinds.append(kind)
            if kind == "urgent":
                self.session.submit(TASKS[URGENT], urgent=True)
            else:
                {
                    "pause": self.executive.pause,
                    "resume": self.executive.resume,
                    "stop": lambda: self.executive.stop("enough"),
                    "cancel": self.cancel,
                }[kind]()

    def cancel(self):
        if any(job.number == 1 and job.state not in OVER for job in self.executive.jobs):
            self.executive.cancel(1)

    def rests(self):
        assert self.body.mode == "stand"
        assert self.body.body().activities["legs"].status != "running"

    def events_of(self, kind):
        return [event.data for event in self.session.journal.recent if event.event == kind]


kinds = st.sampled_from(["pause", "pause", "resume", "urgent"])
moments = st.tuples(st.integers(0, 900), kinds)


@settings(max_examples=5, deadline=None)
@example(events=[])
@given(events=st.lists(moments, max_size=5))
def test_interrupted_at_any_tick_the_job_is_done_once_and_whole(events):
    run = Run(events)
    job, *urgent = run.executive.jobs
    ended = {done.number: done for done in (job, *urgent)}[1]
    assert ended.state == "done", ended.failure
    assert [said["text"] for said in run.events_of("said")].count("Hello.") == 1
    assert not run.body.holding
    assert len([d for d in run.events_of("done") if d.get("job") == 1]) == len(
        list(errands(TASKS[JOB].task))
    )
    cup = run.body.things["cup_red"]
    assert abs(cup.X_WO.p[2] - 0.75) < 0.03
    run.rests()


@settings(max_examples=8, deadline=None)
@example(how="stop", at=681, paused=False, then=True)  # the last step, at rest within a tick
@example(how="stop", at=200, paused=False, then=True)
@given(
    how=st.sampled_from(["stop", "cancel"]),
    at=st.integers(0, 900),
    paused=st.booleans(),
    then=st.booleans(),
)
def test_ended_at_any_tick_the_body_rests_and_can_go_on(how, at, paused, then):
    events = [(at, how)] + ([(max(0, at - 8), "pause")] if paused else [])
    run = Run(events + ([(at + 2, "urgent")] if then else []))
    jobs = {job.number: job for job in run.executive.jobs}
    assert jobs[1].state in ("cancelled", "done")
    assert (2 in jobs) == ("urgent" in run.kinds)  # it may be at rest before that is asked for
    if 2 in jobs:
        assert jobs[2].state == "done", jobs[2].failure
    run.rests()


def test_what_shares_no_part_of_the_body_is_done_side_by_side():
    run = Run([])
    numbers = [
        run.session.submit(understood(text))
        for text in ("squat for three seconds", "look at the table", "say hello", "squat")
    ]
    run.ticks = 0
    run.session.run()
    jobs = {job.number: job for job in run.executive.jobs}
    squat, look, hello, again = (jobs[number] for number in numbers)
    assert {job.state for job in (squat, look, hello, again)} == {"done"}
    assert squat.began_s == look.began_s == hello.began_s
    assert hello.took_s < look.took_s < squat.took_s
    assert again.began_s > squat.began_s + squat.took_s
