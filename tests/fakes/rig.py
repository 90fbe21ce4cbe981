"""A tree on a link without sensors, with fake skills, played tick by tick."""

from __future__ import annotations

from executive.behaviours.sense import Sense
from executive.behaviours.stage import Stage
from executive.blackboard import Blackboard
from executive.health import HealthMonitor
from executive.journal import Journal
from executive.skills.holding import Holdings
from executive.skills.parameters import NavigateParams, PickParams, PlaceParams, WaitParams
from executive.skills.parameters import Step as StepParams
from executive.trees.recovery import Errand
from executive.trees.root import Tree
from executive.trees.tasks import Series, build
from tests.fakes.scripted_skills import SilentLink, Troupe

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


class Rig:
    """A tree on a link without sensors, played tick by tick."""

    def __init__(self, scripts=None, *, rates_hz=None, journal=None):
        self.troupe = Troupe(scripts)
        self.link = SilentLink()
        self.board = Blackboard()
        self.journal = journal or Journal()
        self.operator = self.board.claim("operator")
        self.stage = Stage(self.board, self.journal, self.troupe.make)
        monitor = HealthMonitor(rates_hz or {}, start_s=0.0)
        self.tree = Tree(self.stage, Sense(self.stage, self.link, monitor, holdings=Holdings()))
        self.now_s = 0.0

    def begin(self, *errands: Errand):
        task = Series(name="task", parts=tuple(errands))
        self.tree.begin(build(task, self.stage))
        return self

    def tick(self, count: int = 1):
        for _ in range(count):
            self.tree.tick(self.now_s)
            self.now_s = round(self.now_s + TICK_S, 4)
        return self

    def run(self, limit: int = 2000):
        for _ in range(limit):
            self.tick()
            verdict = self.tree.verdict()
            if verdict is not None:
                return verdict
        raise AssertionError("the tree does not end")

    def events(self, *kinds: str) -> list[str]:
        return [
            f"{event.event} {event.data.get('step', event.data.get('code', ''))}".strip()
            for event in self.journal.recent
            if event.event in kinds
        ]
