"""Expectations of which not all can be met: found by what they say, before anything moves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

import msgspec

from executive.meaning.identify import Scene
from executive.missions.names import Names
from executive.missions.problems import Problems
from intents import goals
from robot.files.yaml_nodes import Node

Fact: TypeAlias = tuple[str, ...]
"""Something that is so: ("holding",), ("holding", cup), ("on", cup, table), or any condition."""


def contradicted(nodes: Iterable[Node], names: Names, scene: Scene) -> Iterator[tuple[Node, Node]]:
    """Conditions that cannot be so together with one before them: both.

    Args:
        nodes: conditions that are all to be so; what is a parameter in one is passed over.
        names: what things are called; what is wrong in a condition is noted elsewhere.
        scene: what there is.
    """
    so: list[tuple[Fact, bool, Node]] = []
    for node in nodes:
        facts = list(_facts(node, names, scene, so=True))
        other = next((at for fact, is_so, at in so if any(
            _excludes(fact, is_so, *one) for one in facts)), None)  # fmt: skip
        if other is not None:
            yield node, other
        so += [(fact, is_so, node) for fact, is_so in facts]


def _excludes(fact: Fact, is_so: bool, other: Fact, other_is_so: bool) -> bool:
    if is_so and other_is_so:
        return fact[:2] == other[:2] and fact[0] == "on" and fact != other
    if not is_so and not other_is_so:
        return False
    held, empty = (fact, other) if is_so else (other, fact)
    return held == empty or (empty == ("holding",) and held[0] == "holding")


def _facts(node: Node, names: Names, scene: Scene, *, so: bool) -> Iterator[tuple[Fact, bool]]:
    """What a condition says, and whether that is so or not."""
    if node.kind == "text":
        condition = names.condition(node, Problems())
        if condition is not None:
            yield from _said(condition, scene, so=so)
        return
    for key, (_, value) in node.entries.items():
        match key:
            case "not":
                yield from _facts(value, names, scene, so=not so)
            case "all" if so:
                for one in value.items:
                    yield from _facts(one, names, scene, so=so)
            case "holding" if isinstance(value.value, bool):
                yield ("holding",), so is value.value
            case "holding":
                query = names.object(value, Problems())
                if query is not None:
                    yield ("holding", _key(query, scene)), so
            case "seen":
                yield from _seen(node, value, names, scene, so=so)
            case _:
                continue


def _seen(
    node: Node, value: Node, names: Names, scene: Scene, *, so: bool
) -> Iterator[tuple[Fact, bool]]:
    query, on = names.object(value, Problems()), node.get("on")
    if query is not None and on is not None and names.place(on, Problems()) is not None:
        yield from _on(query, on.text, scene, so=so)


def _said(condition: goals.Condition, scene: Scene, *, so: bool) -> Iterator[tuple[Fact, bool]]:
    match condition:
        case goals.AllOf(of=several) if so:
            for one in several:
                yield from _said(one, scene, so=so)
        case goals.Holding(object=query, negated=negated):
            yield ("holding", _key(query, scene)), so is not negated
        case goals.Present(object=goals.ObjectQuery(at=str(place)) as query, negated=negated):
            bare = msgspec.structs.replace(query, at=None)
            yield from _on(bare, place, scene, so=so is not negated)
        case _:
            return


def _on(
    query: goals.ObjectQuery, place: str, scene: Scene, *, so: bool
) -> Iterator[tuple[Fact, bool]]:
    """Where a thing is; of several that fit one may be here and one there."""
    if len(scene.fitting(query)) == 1:
        yield ("on", _key(query, scene), place.removeprefix("the ")), so


def _key(query: goals.ObjectQuery, scene: Scene) -> str:
    """The thing that a description means, or the description."""
    infos = scene.fitting(query)
    return infos[0].id if len(infos) == 1 else msgspec.json.encode(query).decode()
