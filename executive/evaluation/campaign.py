"""What is evaluated: cases out of a YAML file, and the runs that they make.

A case is a short mission, the faults that strike in it, and the outcome that is expected.
"""

from __future__ import annotations

import hashlib
import math
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from executive.evaluation import roles
from executive.meaning import request
from executive.missions import check, fault_plans
from executive.missions.load import find
from executive.runs import mission_assignment
from executive.runs.task_run import Assignment
from robot.errors import ConfigError, Problem
from robot.failures import CATALOGUE
from robot.files import config, yaml_nodes
from robot.files.yaml_nodes import Node
from robot.messages import AskedEyes, LocalisedBy
from robot.reality import truth
from robot.reality.contract import IDEAL, USUAL, Reality

SHIPPED = Path(__file__).parent / "campaign.yaml"
RECOVERED = "recovered"
REFUSED = "refused"
"""In place of a code: the sentence leads to nothing, refused or asked back for whatever reason."""
LIMIT_S = 420.0
"""Of robot time: a fetch through three rooms takes some 150 s, with a search and a retry 300 s."""
MOST_CASES = 1000
"""Of a file: each is checked as if it were to be done, which takes milliseconds."""
MOST_RUNS = 100_000
"""Of one evaluation: ten weeks on one core, and half of what a file of results holds."""
BENCH, JUNO = "bench", "juno"
"""Where a sentence is done, and by whom, if nothing else is said."""


class Case(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One row of the table.

    Attributes:
        name: unique in its campaign.
        mission: a sentence, or the path of a mission file.
        world: by name or path; by default a mission file's own, and the bench for a sentence.
        start: where the robot starts (x [m], y [m], heading [deg]); the world's start by default.
        faults: what strikes, and when (`executive.runs.faults`).
        expect: "recovered", or the codes of failure with which it may end safely; a run that is
            done in truth all the same is better than expected.
        helped: whether somebody answers every question with "continue".
        damped: whether the motors may damp at the end, and the robot lie.
        truth: what has to be so in the simulator at the end of a run that is done (`sim.judge`).
        limit_s: simulated time after which a run is ended as hanging.
        why: what the robot is expected to do about it, in words.
        kind: of a task (`executive.evaluation.exam`): a sentence that may well be refused, which
            is a result then, and no mistake of the file.
        person_s: what a person would need for it; 0: nobody said.
        origin: the case that this is in another home (`executive.evaluation.elsewhere`).
    """

    name: str
    mission: str
    world: str = ""
    start: tuple[float, float, float] | None = None
    faults: tuple[dict[str, Any], ...] = ()
    expect: str | tuple[str, ...] = RECOVERED
    helped: bool = False
    damped: bool = False
    truth: tuple[dict[str, Any], ...] = ()
    limit_s: float = LIMIT_S
    why: str = ""
    kind: str = ""
    person_s: float = 0.0
    origin: str = ""

    @property
    def recovers(self) -> bool:
        """Whether it is expected to be done in spite of the fault."""
        return self.expect == RECOVERED

    @property
    def codes(self) -> tuple[str, ...]:
        """The codes that it is expected to fail with, none if it is to recover."""
        return () if isinstance(self.expect, str) else self.expect


class Campaign(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A file of cases; `roles` say what plays the roles that they name (`evaluation.roles`)."""

    cases: Annotated[tuple[Case, ...], Meta(max_length=MOST_CASES)]
    roles: dict[str, Any] = {}


def key_of(case: str, seed: int, *, recovery: bool) -> str:
    """The name of a run, unique in a campaign."""
    return f"{case}/{seed}" + ("" if recovery else "/no-recovery")


class Run(msgspec.Struct, frozen=True, kw_only=True):
    """One run of a case: all that a worker needs to know.

    `robot`, by name or path, stands for that of the mission where it is not empty. `reality` is a
    profile (docs/realities.md), left out where it is the one without flaws. `eyes` find the things;
    left out where they are the oracle's. `localisation` says where it is, left out in the same way.
    """

    case: Case
    seed: int
    recovery: bool = True
    robot: str = ""
    reality: str | msgspec.UnsetType = msgspec.UNSET
    eyes: AskedEyes | msgspec.UnsetType = msgspec.UNSET
    localisation: LocalisedBy | msgspec.UnsetType = msgspec.UNSET

    @property
    def key(self) -> str:
        """Unique in a campaign."""
        return key_of(self.case.name, self.seed, recovery=self.recovery)

    @property
    def digest(self) -> str:
        """Of all that is run (not of the code): equal keys may be of different missions."""
        return hashlib.sha256(msgspec.json.encode(self, order="deterministic")).hexdigest()[:16]


def load(path: Path | str, reality: Reality, *, robot: str = "") -> tuple[Case, ...]:
    """Read a campaign, and check every word of it before anything is run.

    Raises:
        ConfigError: with file, line and the nearest valid name.
    """
    node = read(path)
    cases = config.convert(node, Campaign).cases
    settings = Settings(reality, robot)
    problems = [
        config.place(node, f"$.cases[{index}]").problem(f"{case.name}: {text}")
        for index, case in enumerate(cases)
        for text in problems_of(case, settings)
    ]
    first = {case.name: index for index, case in reversed([*enumerate(cases)])}
    problems += [
        config.place(node, f"$.cases[{index}]").problem(f"there are two cases {case.name!r}")
        for index, case in enumerate(cases)
        if first[case.name] != index
    ]
    if not cases:
        problems.append(node.problem("there are no cases in it", "see docs/evaluation.md"))
    if problems:
        raise ConfigError(problems)
    return cases


def read(path: Path | str) -> Node:
    """A campaign's file, its roles played as it says. Raises ConfigError by file and line."""
    node = yaml_nodes.read(path)
    return roles.filled(node, roles.of(node))


def check_names(cases: Sequence[Case]) -> None:
    """Refuse cases that cannot be told apart. Raises ConfigError."""
    several = Counter(case.name for case in cases)
    problems = [
        Problem(f"{count} cases are called {name!r}", suggestion="name each once")
        for name, count in several.items()
        if count > 1
    ]
    if problems:
        raise ConfigError(problems[: config.MOST_PROBLEMS])


def check_count(runs: int) -> None:
    """Refuse more runs than an evaluation has, before they are made. Raises ConfigError."""
    if runs > MOST_RUNS:
        text = f"{runs} runs; one evaluation has at most {MOST_RUNS}"
        raise ConfigError([Problem(text, suggestion="fewer seeds, cases or homes")])


class Meant(msgspec.Struct, frozen=True, kw_only=True):
    """What a case's mission is, and where it is done.

    `remark` is what people are told of how it was understood: of words that were taken for others.
    """

    assignment: Assignment
    where: request.Setting
    remark: str = ""


class Settings:
    """Worlds by name, each read once, with a robot in them.

    Attributes:
        reality: that the worlds are of.
        robot: in place of the missions' own; empty: theirs.
    """

    def __init__(self, reality: Reality, robot: str = "") -> None:
        """Read nothing yet."""
        self.reality = reality
        self.robot = robot
        self._known: dict[str, request.Setting] = {}

    def of(self, world: str) -> request.Setting:
        """The robot in a world, by name or path. Raises ConfigError as `request.setting` does."""
        if world not in self._known:
            self._known[world] = request.setting(self.reality, world, robot=self.robot or JUNO)
        return self._known[world]


def meant(case: Case, settings: Settings) -> Meant | request.Refused:
    """Understand a case's mission: a sentence, or a mission file, which may bring its own world.

    Raises:
        ConfigError: a world or a mission file is wrong.
    """
    if case.mission.endswith((".yaml", ".yml")):
        options = check.Options(
            samples=True, world=case.world or None, robot=settings.robot or None
        )
        checked = check.check(find(case.mission), settings.reality, options)
        made = mission_assignment.assignment(checked, options, path=case.mission)
        remark = "; ".join(note.message for note in checked.notes)
        return Meant(assignment=made, where=checked.where, remark=remark)
    where = settings.of(case.world or BENCH)
    understood = request.request(case.mission, where)
    if isinstance(understood, request.Refused):
        return understood
    made = Assignment(understood=understood)
    return Meant(assignment=made, where=where, remark=understood.remark)


def where(case: Case, settings: Settings) -> request.Setting:
    """Robot and world of a case, whether its mission is understood or not.

    Raises:
        ConfigError: a world or a mission file is wrong.
    """
    if case.mission.endswith((".yaml", ".yml")):
        given = meant(case, settings)
        assert isinstance(given, Meant)  # only a sentence can be refused
        return given.where
    return settings.of(case.world or BENCH)


def problems_of(case: Case, settings: Settings) -> list[str]:
    """Everything wrong with a case that can be found without running it."""
    found = [
        f"unknown failure code {code!r}; {config.nearest(code, list(CATALOGUE))}"
        for code in case.codes
        if code not in CATALOGUE
    ]
    if isinstance(case.expect, str) and case.expect != RECOVERED:
        found.append(f"expect is {RECOVERED!r} or a list of codes, not {case.expect!r}")
    if not 0.0 < case.limit_s < math.inf:
        found.append("limit_s is a time above 0")
    try:
        given = meant(case, settings)
        if isinstance(given, request.Refused):
            return [*found, f"{case.mission!r}: {given.reason}"]
        truth.read(case.truth, given.where.world_map)
        for data in case.faults:
            fault_plans.verify(
                fault_plans.plan(data).fault, given.where.world, given.where.description
            )
    except ConfigError as error:
        found += [str(problem) for problem in error.problems]
    return found


def _by_oracle(_case: Case) -> LocalisedBy:
    return "oracle"


def _told(by: LocalisedBy) -> LocalisedBy | msgspec.UnsetType:
    return msgspec.UNSET if by == "oracle" else by


def runs(
    cases: tuple[Case, ...],
    *,
    seeds: int,
    without_too: bool,
    robot: str,
    reality: str = USUAL,
    eyes: AskedEyes = "oracle",
    localised: Callable[[Case], LocalisedBy] = _by_oracle,
) -> list[Run]:
    """Every case with every seed, the seeds outermost, so that all cases get on evenly.

    Args:
        cases: what to run.
        seeds: how many of each, from 0.
        without_too: whether to run everything a second time without recovery.
        robot: who does it.
        reality: in which.
        eyes: who tells the robot where the things are.
        localised: who tells it where it is, in each case.

    Raises:
        ConfigError: they are more than `MOST_RUNS`.
    """
    ways = (True, False) if without_too else (True,)
    check_count(len(cases) * seeds * len(ways))
    profile = msgspec.UNSET if reality == IDEAL else reality
    seen_by = msgspec.UNSET if eyes == "oracle" else eyes
    told: dict[str, LocalisedBy | msgspec.UnsetType]
    told = {case.name: _told(localised(case)) for case in cases}
    return [
        Run(
            case=case,
            seed=seed,
            recovery=recovery,
            robot=robot,
            reality=profile,
            eyes=seen_by,
            localisation=told[case.name],
        )
        for seed in range(seeds)
        for case in cases
        for recovery in ways
    ]
