"""`python -m benchmarks.overhead`: what a tick of the executive costs beside bare py_trees.

A tree of 1,000 nodes is ticked by both, in turns inside one run, so that a busy machine slows
both. py_trees' has its stock leaves; the executive's has the same shape of its own leaves, which
read the board and run skills, and the executive does all that it does besides: sensing, health,
jobs, the recorder of trees, the journal. Two shapes: `all` ticks every node in every tick; `one` is
a task of steps of which one runs, where py_trees has next to nothing to do and only the difference
in µs says something.
"""

from __future__ import annotations

import gc
import statistics
import time
from collections.abc import Callable
from typing import NamedTuple

from py_trees.behaviour import Behaviour
from py_trees.behaviours import Failure, Running, Success
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence

from executive.behaviours.conditions import Check
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.stage import Stage
from executive.blackboard import Blackboard
from executive.engine.executive import Executive
from executive.engine.recorder import Recorder
from executive.journal.journal import Journal
from executive.runs.session import RATES_HZ
from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.script import Script
from executive.skills.scripted import ScriptedSkill
from executive.skills.wait import WaitParams
from tests.fakes.oracle_planner import RulePlanner
from tests.fakes.worlds import JUNO, puppet

NODES = 1000
TICK_S = 0.05
WARM_UP, BLOCKS, BLOCK = 40, 60, 10
MOST = 1.3


class Still(ScriptedSkill[WaitParams]):
    """Waits for ever."""

    resources = frozenset()

    @classmethod
    def forecast(cls, wanted: WaitParams, outlook: Outlook) -> Forecast:  # noqa: ARG003
        """Nobody asks."""
        return Forecast(0.0)

    def script(self) -> Script[None]:
        """Wait."""
        while True:
            yield


def no(_board: Blackboard) -> bool:
    return False


def yes(_board: Blackboard) -> bool:
    return True


class Leaves(NamedTuple):
    """What trees are made of: a question answered yes or no, and a step that goes on."""

    yes: Callable[[], Behaviour]
    no: Callable[[], Behaviour]
    step: Callable[[], Behaviour]


STOCK = Leaves(lambda: Success("yes"), lambda: Failure("no"), lambda: Running("step"))


def own(stage: Stage) -> Leaves:
    """The executive's leaves."""
    return Leaves(
        lambda: Check("yes", yes, board=stage.board),
        lambda: Check("no", no, board=stage.board),
        lambda: RunSkill("step", WaitParams(), stage=stage, limit_s=1e9),
    )


def all_ticked(leaves: Leaves) -> Behaviour:
    """Branches side by side; in each, questions that are asked in every tick, and one step."""
    branches: list[Behaviour] = []
    for index in range((NODES - 1) // 10):
        checks = [leaves.yes() for _ in range(6)]
        last = Selector("or", memory=False, children=[leaves.no(), leaves.step()])
        branches.append(Sequence(f"branch {index}", memory=False, children=[*checks, last]))
    policy = ParallelPolicy.SuccessOnAll(synchronise=False)
    return Parallel("task", policy=policy, children=branches)


def one_ticked(leaves: Leaves) -> Behaviour:
    """Steps in order; the first one never ends."""
    return Sequence("task", memory=True, children=[leaves.step() for _ in range(NODES - 1)])


class Bench:
    """One tree, ticked by the executive or by py_trees."""

    def __init__(self, build: Callable[[Leaves], Behaviour], *, recorded: bool) -> None:
        """Submit the tree, and begin."""
        self.body = puppet()
        context = SkillContext(link=self.body, planner=RulePlanner(), description=JUNO)
        self.executive = Executive(
            context, Journal(), rates_hz=RATES_HZ, make=lambda _, given: Still(WaitParams(), given)
        )
        self.recorder = Recorder(self.executive) if recorded else None
        self.executive.submit(lambda stage: build(own(stage)), text="benchmark")
        self.task = build(STOCK)
        self.nodes = sum(1 for _ in self.task.iterate())
        for _ in range(WARM_UP):
            self.full()
            self.bare()
        task = self.executive.tree.jobs.children[-1]
        assert task.status is self.task.status is Status.RUNNING

    def full(self) -> float:
        """A tick of the executive [s]."""
        self.body.tick()
        begin = time.perf_counter()
        self.executive.tick(self.body.time_s)
        if self.recorder is not None:
            self.recorder.update()
        return time.perf_counter() - begin

    def bare(self) -> float:
        """A tick of py_trees alone [s]."""
        begin = time.perf_counter()
        self.task.tick_once()
        return time.perf_counter() - begin


def measure(bench: Bench) -> tuple[list[float], list[float]]:
    """Durations of ticks, full and bare, in turns."""
    full: list[float] = []
    bare: list[float] = []
    for _ in range(BLOCKS):
        full += [bench.full() for _ in range(BLOCK)]
        bare += [bench.bare() for _ in range(BLOCK)]
    return full, bare


def main() -> int:
    gc.disable()
    worst = 0.0
    print("| tree | nodes | py_trees [µs] | executive [µs] | more [µs] | ratio |")
    print("|---|---|---|---|---|---|")
    for name, build in (("all", all_ticked), ("one", one_ticked)):
        for recorded in (False, True):
            bench = Bench(build, recorded=recorded)
            full, bare = (1e6 * statistics.median(values) for values in measure(bench))
            if name == "all":
                worst = max(worst, full / bare)
            label = f"{name} ticked{', recorded' if recorded else ''}"
            print(
                f"| {label} | {bench.nodes} | {bare:.0f} | {full:.0f} | {full - bare:.0f} "
                f"| {full / bare:.2f} |"
            )
    print(f"\nat most {MOST} where every node is ticked: {worst:.2f}")
    return 0 if worst <= MOST else 1


if __name__ == "__main__":
    raise SystemExit(main())
