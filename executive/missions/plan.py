"""A dry run: every step with its path, about how long it takes, and whether the way is free.

Each skill forecasts its own step, in the world as the steps before have left it
(`executive.missions.rehearsal`). A way takes as long as it takes a point that is led along it
(`executive.skills.motions.pacing`), what is done at its end a typical time, measured in `--fast`
runs (docs/missions.md).
What turns out only on the way (a branch's answer, the rounds of a `while`, recoveries) is named,
not guessed: a branch counts with its longer side, a `while` with one round.
"""

from __future__ import annotations

import msgspec

from executive.meaning.request import Setting
from executive.missions.rehearsal import Rehearsal
from executive.skills.catalogue import skill_of
from executive.skills.forecast import Forecast, Outlook
from executive.skills.parameters import SkillParams
from executive.skills.say import SPEAK_S
from executive.trees import parts as p
from robot.se3 import SE3


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """A step of the plan.

    Attributes:
        path: where it stands in the mission.
        depth: how deep.
        name: for people.
        kind: "step", or what holds steps ("loop", "branch", ...).
        takes_s: about how long it takes; None where it cannot be said.
        problem: why it would fail as things stand; empty if nothing is known against it.
    """

    path: str
    depth: int
    name: str
    kind: str
    takes_s: float | None = None
    problem: str = ""


class Plan(msgspec.Struct, frozen=True, kw_only=True):
    """A dry run: its rows, the time in all, and what is known against it.

    Attributes:
        rows: the steps.
        total_s: the time in all.
        problems: how many steps will not work.
        problem: why the whole would fail, where that is not for one of its steps.
    """

    rows: tuple[Row, ...]
    total_s: float
    problems: int
    problem: str = ""


def forecast(
    task: p.Part,
    where: Setting,
    *,
    done: frozenset[str] = frozenset(),
    X_WS: SE3 | None = None,
) -> Plan:
    """What a task would take, step by step.

    Args:
        task: what is to be done.
        where: robot and world.
        done: paths of what is left out.
        X_WS: where the robot stands before it (None: where the world file has it).
    """
    rows: list[Row] = []
    forecaster = _Forecaster(Rehearsal(where, X_WS=X_WS), done, rows)
    total_s = round(forecaster.part(task, "", 0), 1)
    problems = sum(1 for row in rows if row.problem)
    return Plan(rows=tuple(rows), total_s=total_s, problems=problems, problem=forecaster.problem)


def forecast_lines(task: p.Part, where: Setting) -> list[str]:
    """A dry run in words, a line a step."""
    return lines(forecast(task, where))


def lines(plan: Plan) -> list[str]:
    """A plan in words, a line a step."""
    width = max((len(row.path) for row in plan.rows), default=0)
    found: list[str] = []
    for row in plan.rows:
        takes = "" if not row.takes_s else _about(row.takes_s)
        text = f"  {row.path:{width}}  {'  ' * row.depth}{row.name}"
        found.append(f"{text:60}  {takes}".rstrip())
        if row.problem:
            found.append(f"  {'':{width}}  {'  ' * row.depth}  will not work: {row.problem}")
    minutes, seconds = divmod(round(plan.total_s), 60)
    total = f"{minutes} min {seconds} s" if minutes else f"{seconds} s"
    found.append(f"In all about {total}, without recoveries.")
    if plan.problem:
        found.append(f"  will not work: {plan.problem}")
    return found


def _about(takes_s: float) -> str:
    return f"about {takes_s:.0f} s" if takes_s >= 0.5 else "under 1 s"


class _Forecaster:
    """Follows the robot through a task."""

    def __init__(self, outlook: Rehearsal, done: frozenset[str], rows: list[Row]) -> None:
        self._done, self._rows = done, rows
        self._outlook = outlook
        self.problem = ""

    def part(self, part: p.Part, path: str, depth: int) -> float:
        """Add the rows of a part; returns how long it takes [s]."""
        if f"{path}/" in self._done or path in self._done:
            return 0.0
        match part:
            case p.Errand():
                return self._errand(part, path, depth)
            case p.Series():
                return self._series(part, path, depth)
            case p.Branch():
                spans = self._rows_inside(part, path, depth)
                look_s = spans.pop(0) if part.look is not None else 0.0
                return look_s + max(spans)
            case p.Parallel():
                return max(self._rows_inside(part, path, depth), default=0.0)
            case p.Settle() | p.Each():
                return sum(self._rows_inside(part, path, depth))
            case p.Loop():
                return self._loop(part, path, depth)
            case p.Timeout():
                return self._limited(part, path, depth)
            case p.Retry() | p.OnFail():
                return self.part(part.part, path, depth)
            case p.Always():
                span_s = self.part(part.part, path, depth)
                return span_s + self.part(part.after, p.below(path, "always"), depth)
            case p.Kept():
                return 0.0
            case p.GiveUp() | p.Expect():
                self._row(path, depth, part.name, "step", takes_s=0.0)
                return 0.0

    def _rows_inside(self, part: p.Part, path: str, depth: int) -> list[float]:
        """Add a part's own row and those of what it holds; returns how long each takes [s]."""
        self._row(path, depth, part.name, type(part).__name__.lower())
        return [self.part(child, at, depth + 1) for at, child in p.children(part, path)]

    def _row(
        self,
        path: str,
        depth: int,
        name: str,
        kind: str,
        *,
        takes_s: float | None = None,
        problem: str = "",
    ) -> None:
        if path:
            row = Row(
                path=path, depth=depth, name=name, kind=kind, takes_s=takes_s, problem=problem
            )
            self._rows.append(row)

    def _series(self, part: p.Series, path: str, depth: int) -> float:
        if part.parts or path.rpartition(".")[2].isdigit():  # a step that is there, if of nothing
            self._row(path, depth, part.name, "series")
        inside = depth + 1 if path else depth
        return sum(self.part(child, at, inside) for at, child in p.children(part, path))

    def _limited(self, part: p.Timeout, path: str, depth: int) -> float:
        at, span_s = len(self._rows), self.part(part.part, path, depth)
        if span_s > part.limit_s:
            problem = f"it has {part.limit_s:g} s, and takes {_about(span_s)}"
            if not path:
                self.problem = problem
            elif at < len(self._rows) and not self._rows[at].problem:
                self._rows[at] = msgspec.structs.replace(self._rows[at], problem=problem)
        return span_s

    def _loop(self, part: p.Loop, path: str, depth: int) -> float:
        self._row(path, depth, part.name, "loop")
        spans = [self.part(c, w, depth + 1) for w, c in p.children(part, path)]
        if part.question is not None:
            return spans[0]
        before = len(self._rows)  # one more round, from where the first ones end
        last_s = self.part(part.bodies[-1], p.of_round(path, len(spans) + 1), depth + 1)
        del self._rows[before:]
        return sum(spans) + last_s * (part.at_most - len(spans))

    # --- steps ---

    def _errand(self, errand: p.Errand, path: str, depth: int) -> float:
        told = _forecast(errand, self._outlook)
        takes_s = round(told.takes_s, 1)
        self._row(path, depth, errand.name, "step", takes_s=takes_s, problem=told.problem)
        return told.takes_s


def _forecast(errand: p.Errand, outlook: Outlook) -> Forecast:
    """What a step takes. Parameters made from the blackboard are those of speech."""
    params = errand.params
    if isinstance(params, SkillParams):
        return skill_of(params).forecast(params, outlook)
    return Forecast(SPEAK_S)
