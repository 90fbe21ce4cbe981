"""What the front end shows of a robot at work, as one value made after each tick."""

from __future__ import annotations

import math
from collections import deque

import msgspec
from msgspec.structs import replace

from executive.blackboard import BODY, HELD, HELP, PHASE, WORLD
from executive.engine.executive import Executive
from executive.engine.jobs import UNDER_WAY
from executive.health import Level
from executive.journal.snapshot import Shown, at_work, in_order
from robot.failures import Failure

PACE_SPAN_S = 2.0
PANEL_PERIOD_S = 0.2
STEPS_PERIOD_S = 1.0
"""Between two looks at how many steps are done: a tree of 1,000 nodes takes milliseconds."""


class View(msgspec.Struct, frozen=True, kw_only=True):
    """A robot as of one tick.

    Attributes:
        time_s: the runtime's time.
        state: of the executive: idle, working, pausing, paused, stopping.
        mode: of the body: damping, stand, walk, fallen; "gone" when nothing is left of it.
        low: whether it squats, which to the body is standing as well.
        pose: estimated x [m], y [m] and heading [degrees] in the world, None before the first fix.
        goal: what the first job under way was asked for.
        phase: what the newest skill does.
        steps: of the newest job under way, the steps that are behind it, and all that it has now.
        waiting: jobs in the queue.
        level: of the worst finding about the robot's health.
        unwell: what that finding is.
        held: what is in the hands.
        help: what the robot asks a person for.
        pace: simulated seconds a second of wall time.
        tree: the running job's tree in reading order, with depths, if somebody looks at it.
    """

    time_s: float = 0.0
    state: str = "idle"
    mode: str = "damping"
    low: bool = False
    pose: tuple[float, float, float] | None = None
    goal: str = ""
    phase: str = ""
    steps: tuple[int, int] = (0, 0)
    waiting: int = 0
    level: Level = Level.OK
    unwell: str = ""
    held: tuple[str, ...] = ()
    help: str = ""
    pace: float = 1.0
    tree: tuple[tuple[int, Shown], ...] = ()


def view_of_lost(last: View, lost: Failure) -> View:
    """A robot that is gone, as it was seen last."""
    return replace(
        last, mode="gone", state="idle", goal="", phase="", steps=(0, 0), waiting=0, help="",
        tree=(), pace=0.0, level=Level.DAMP, unwell=lost.cause,
    )  # fmt: skip


class Observer:
    """Makes views of an executive; called by the thread that ticks it."""

    def __init__(self, *, low_base_m: float = 0.0) -> None:
        """Nobody looks at the tree yet; a base below `low_base_m` is that of a squat."""
        self._low_base_m = low_base_m
        self.tree_wanted = False
        self._tree: tuple[tuple[int, Shown], ...] = ()
        self._tree_wall_s = -math.inf
        self._steps, self._steps_wall_s = (0, 0), -math.inf
        self._stamps: deque[tuple[float, float]] = deque()

    def look(self, executive: Executive, *, now_s: float, wall_s: float) -> View:
        """The robot now.

        Args:
            executive: between two ticks.
            now_s: the runtime's time.
            wall_s: wall time, for the pace and for how often the tree is read.
        """
        board = executive.board
        body, world, health = board.read(BODY), board.read(WORLD), executive.health
        running = [job for job in executive.jobs if job.state in UNDER_WAY]
        phase = board.read(PHASE) if running else ""
        pose = None
        if world is not None:
            X_WB = world.X_WB
            pose = (X_WB.p[0], X_WB.p[1], math.degrees(X_WB.yaw_rad))
        return View(
            time_s=now_s,
            state=executive.state,
            mode=body.mode if body else "damping",
            low=body is not None and body.X_NB.p[2] - body.X_NS.p[2] < self._low_base_m,
            pose=pose,
            goal=running[0].text if running else "",
            phase="" if phase == "done" else phase,
            steps=self._count_steps(executive, wall_s) if running else (0, 0),
            waiting=sum(1 for job in executive.jobs if job.state == "waiting"),
            level=health.level,
            unwell=health.failure.cause if health.failure else "",
            held=tuple(f"{side}: {name}" for side, name in board.read(HELD).items()),
            help=board.read(HELP),
            pace=self._pace(now_s, wall_s),
            tree=self._read_tree(executive, wall_s),
        )

    def _pace(self, now_s: float, wall_s: float) -> float:
        stamps = self._stamps
        stamps.append((wall_s, now_s))
        while len(stamps) > 2 and wall_s - stamps[0][0] > PACE_SPAN_S:
            stamps.popleft()
        past_s = wall_s - stamps[0][0]
        return (now_s - stamps[0][1]) / past_s if past_s > 0.1 else 1.0

    def _count_steps(self, executive: Executive, wall_s: float) -> tuple[int, int]:
        if wall_s - self._steps_wall_s >= STEPS_PERIOD_S:
            self._steps_wall_s = wall_s
            shown = [one for _, one in in_order(at_work(executive.so_far))]
            leaves = [one for one in shown if not one.children]
            behind = sum(one.state in ("done", "failed", "stopped") for one in leaves)
            self._steps = behind, len(leaves)
        return self._steps

    def _read_tree(self, executive: Executive, wall_s: float) -> tuple[tuple[int, Shown], ...]:
        if not self.tree_wanted:
            return ()
        if wall_s - self._tree_wall_s >= PANEL_PERIOD_S:
            self._tree_wall_s = wall_s
            self._tree = tuple(in_order(at_work(executive.so_far)))
        return self._tree
