"""A tree on a link without sensors, with fake skills, played tick by tick."""

from __future__ import annotations

from executive.engine.executive import Executive
from executive.journal.journal import Journal
from executive.skills.context import SkillContext
from executive.skills.navigate import NavigateParams
from executive.skills.navigate import Step as StepParams
from executive.skills.pick import PickParams
from executive.skills.place import PlaceParams
from executive.skills.wait import WaitParams
from executive.trees.build import build
from executive.trees.parts import Series
from executive.trees.recovery import Errand
from robot.model.description import load
from tests.fakes.scripted_skills import SilentLink, Troupe

JUNO = load("juno")

TICK_S = 0.05
WALK = Errand(name="walk", params=NavigateParams(by=StepParams(forward_m=1.0)))
PICK = Errand(name="pick", params=PickParams(object_id="cup"), object_id="cup", object_name="cup")
PUT = Errand(
    name="put",
    params=PlaceParams(object_id="cup", place_id="shelf"),
    object_id="cup",
    object_name="cup",
    carries=True,
)
WAIT = Errand(name="wait", params=WaitParams(duration_s=1.0))


class Planner:
    """Nobody asks it anything."""


class Rig:
    """An executive on a link without sensors, with fake skills, played tick by tick."""

    def __init__(self, scripts=None, *, rates_hz=None, journal=None):
        self.troupe = Troupe(scripts)
        self.link = SilentLink()
        self.journal = journal or Journal()
        context = SkillContext(link=self.link, planner=Planner(), description=JUNO)  # type: ignore
        self.executive = Executive(
            context,
            self.journal,
            rates_hz=rates_hz or {},
            make=lambda params, given: self.troupe.make(params, given.seed),
        )
        self.board = self.executive.board
        self.stage = self.executive.stage
        self.tree = self.executive.tree
        self.now_s = 0.0

    def submit(self, *errands: Errand, **how) -> int:
        task = Series(name="task", parts=tuple(errands))
        return self.executive.submit(lambda stage: build(task, stage), text="task", **how)

    def begin(self, *errands: Errand):
        self.submit(*errands)
        return self

    def tick(self, count: int = 1):
        for _ in range(count):
            self.executive.tick(self.now_s)
            self.now_s = round(self.now_s + TICK_S, 4)
        return self

    def run(self, limit: int = 2000):
        """Tick to the outcome: True, or the failure."""
        for _ in range(limit):
            self.tick()
            if self.executive.outcome is not None:
                return self.executive.outcome.failure or True
        raise AssertionError("the tree does not end")

    def events(self, *kinds: str) -> list[str]:
        return [
            f"{event.event} {event.data.get('step', event.data.get('code', ''))}".strip()
            for event in self.journal.recent
            if event.event in kinds
        ]

    def at(self, *kinds: str) -> list[tuple[float, str, dict]]:
        """When which events were journalled, with what they say."""
        recent = self.journal.recent
        return [(event.t_s, event.event, event.data) for event in recent if event.event in kinds]

    @property
    def states(self) -> dict[int, str]:
        """Every job's state, by number."""
        return {job.number: job.state for job in self.executive.jobs}
