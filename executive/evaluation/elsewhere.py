"""A campaign that moves house: the same faults in homes that are made from seeds.

Each case is done in each home, on a task made for that home: its roles are played by what is
there and within reach (`executive.evaluation.roles`). Where nothing can play one of them the case
makes no sense: it is skipped, said, and counted nowhere.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Sequence
from pathlib import Path

import msgspec

from executive.evaluation import campaign, roles
from executive.evaluation.campaign import Campaign, Case, Settings
from robot.errors import ConfigError, Problem
from robot.files import config, yaml_nodes
from robot.files.misfits import shown
from robot.files.yaml_nodes import Node
from robot.reality.contract import Cast, Reality

MOST_HOMES = 1000
MOST_SEED = 999_999_999
MOST_DIGITS = 12
SEARCH_S = 30.0
"""Of robot time for each surface: who looks for what is gone looks on all of them, and in an office
with 32 was not through after 420 s."""
HOW = "--homes flat:7,office:8, or a number of homes"
AT_HOME_ONLY = "it is written for one home: it names no role (docs/evaluation.md)"


class Skipped(msgspec.Struct, frozen=True, kw_only=True):
    """A case that makes no sense in a home, and why."""

    home: str
    fault: str
    why: str


class Moved(msgspec.Struct, frozen=True, kw_only=True):
    """All cases in all homes."""

    cases: tuple[Case, ...]
    skipped: tuple[Skipped, ...]


def homes(words: str, reality: Reality) -> tuple[str, ...]:
    """The homes that are meant, each `KIND:SEED`.

    Args:
        words: such names with commas between; or a number: so many homes, the kinds in turn, the
            seeds from 0.
        reality: where they come from.

    Raises:
        ConfigError: with everything that is wrong in them.
    """
    kinds = reality.home_kinds()
    if words.strip().isdecimal():
        count = _number(words.strip(), MOST_HOMES)
        if not count:
            text = f"{shown(words)} homes; from 1 to {MOST_HOMES} are taken"
            raise ConfigError([Problem(text, "--homes", suggestion=HOW)])
        return tuple(f"{kinds[i % len(kinds)]}:{i // len(kinds)}" for i in range(count))
    counted = Counter(word.strip() for word in words.split(",") if word.strip())
    names = list(counted)
    problems = [problem for name in names for problem in _wrong_in(name, kinds)]
    problems += [
        Problem(f"{shown(name)} stands there twice", "--homes", suggestion="name each home once")
        for name, count in counted.items()
        if count > 1
    ]
    if len(names) > MOST_HOMES:
        problems.insert(0, Problem(f"more than {MOST_HOMES} homes", "--homes", suggestion=HOW))
    if not names:
        problems.append(Problem("no home is named", "--homes", suggestion=HOW))
    if problems:
        raise ConfigError(problems[: config.MOST_PROBLEMS])
    return tuple(names)


def _wrong_in(name: str, kinds: Sequence[str]) -> list[Problem]:
    kind, _, seed = name.partition(":")
    if kind not in kinds:
        hint = config.nearest(kind, list(kinds))
        return [Problem(f"unknown kind of home {shown(kind)}", "--homes", suggestion=hint)]
    if not (seed.isascii() and seed.isdecimal() and _number(seed, MOST_SEED) is not None):
        text = f"{shown(name)} is no home"
        return [Problem(text, "--homes", suggestion=f"{kind} and a seed: {kind}:7")]
    return []


def _number(digits: str, most: int) -> int | None:
    """What digits say; None if it is more: Python reads no number of thousands of them."""
    number = int(digits) if len(digits) <= MOST_DIGITS else most + 1
    return number if number <= most else None


def moved(
    files: Sequence[Path], names: Sequence[str], settings: Settings, *, only: Container[str] = ()
) -> Moved:
    """Move the cases of campaigns into homes.

    Args:
        files: the campaigns.
        names: of the homes, each `KIND:SEED`.
        settings: where they are.
        only: these cases; empty: all.

    Raises:
        ConfigError: a file is wrong where it is at home already.
    """
    cases: list[Case] = []
    skipped: list[Skipped] = []
    read = 0
    for path in files:
        at_home = campaign.load(path, settings.reality, robot=settings.robot)
        read += len(at_home)
        campaign.check_count(read * len(names))
        node = yaml_nodes.read(path).get("cases")
        written = list(zip(at_home, node.items if node else (), strict=True))
        for name in names:
            kind, _, seed = name.partition(":")
            cast = settings.reality.cast(kind, seed=int(seed))
            for case, entry in written:
                if only and case.name not in only:
                    continue
                one = _moved(case, entry, name, cast, settings)
                if isinstance(one, Case):
                    cases.append(one)
                else:
                    skipped.append(Skipped(home=name, fault=case.name, why=one))
    campaign.check_names(cases)
    return Moved(cases=tuple(cases), skipped=tuple(skipped))


def _moved(case: Case, entry: Node, name: str, cast: Cast, settings: Settings) -> Case | str:
    """A case in a home, or why it makes no sense there."""
    needed = roles.used(entry)
    if not needed or case.world:
        return AT_HOME_ONLY
    for role in needed:
        if role not in cast.roles:
            return cast.vacant.get(role, f"nobody plays the role {role!r} there")
    filled = config.convert(_alone(roles.filled(entry, cast.roles)), Campaign).cases[0]
    surfaces = sum(not place.floor for place in settings.of(name).world_map.places)
    there = msgspec.structs.replace(
        filled,
        name=f"{case.name} in {name}",
        world=name,
        origin=case.name,
        limit_s=max(filled.limit_s, SEARCH_S * surfaces),
    )
    problems = campaign.problems_of(there, settings)
    return problems[0] if problems else there


def _alone(entry: Node) -> Node:
    """A campaign of one case."""
    root = Node("map", entry.file, entry.line, entry.column)
    cases = Node("list", entry.file, entry.line, entry.column)
    cases.items = [entry]
    root.entries["cases"] = (yaml_nodes.text_node("cases", entry), cases)
    return root
