"""What should be so at the end of a run, and how it truly was: what evaluations judge by.

A check is a mapping of one of these forms (docs/evaluation.md); `within_m` is a bound that may be
given with all that measure a distance:

    {object, on: PLACE}  {object, held: true}  {object, near: OTHER}  {object, with_person: PERSON}
    {not_moved: OBJECT}  {at: [x, y]}  {robot_in: ROOM}  {robot_near: PERSON}
    {visited: [ROOM, ...]}  {passed: [PERSON, ...]}  {passed_at: [x, y]}
    {said: REGULAR EXPRESSION}  {any: [CHECK, ...]}
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from robot.errors import ConfigError, Problem
from robot.files import config, patterns
from robot.files.misfits import misfits, shown
from robot.messages import WorldMap

FORMS: dict[frozenset[str], float | None] = {
    frozenset({"object", "on"}): None,
    frozenset({"object", "held"}): None,
    frozenset({"object", "near"}): 0.30,
    frozenset({"object", "with_person"}): 1.5,
    frozenset({"not_moved"}): 0.05,
    frozenset({"at"}): 0.15,
    frozenset({"robot_in"}): None,
    frozenset({"robot_near"}): 1.5,
    frozenset({"visited"}): None,
    frozenset({"passed"}): 1.5,
    frozenset({"passed_at"}): 0.7,
    frozenset({"said"}): None,
    frozenset({"any"}): None,
}
"""What is given together, and the distance [m] that counts if none is said; None: no distance."""

_FORMS = ", ".join("{" + ", ".join(sorted(form, reverse=True)) + "}" for form in FORMS)
_Distance = Annotated[float, Meta(ge=0.0, le=100.0)]
_Point = tuple[float, float]


class Check(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One thing that should be so at the end, or should have been so on the way.

    Attributes:
        object: it is `on` a place (or on any of a piece of furniture), `held`, `near` another
            object, or `with_person`.
        not_moved: an object that is where it was at the start.
        at: a point of the floor [m] that the robot stands at.
        robot_in: a room that it stands in.
        robot_near: a person whom it stands near.
        visited: rooms that it was in, in this order, others between them.
        passed: people whom it was near, in this order.
        passed_at: a point of the floor [m] that it was at.
        said: a regular expression (`robot.files.patterns`) that something it said aloud contains.
        any: checks of which one is enough.
        within_m: the distance that counts, between centres.
    """

    object: str = ""
    on: str = ""
    held: bool = False
    near: str = ""
    with_person: str = ""
    not_moved: str = ""
    at: _Point | None = None
    robot_in: str = ""
    robot_near: str = ""
    visited: tuple[str, ...] = ()
    passed: tuple[str, ...] = ()
    passed_at: _Point | None = None
    said: str = ""
    any: tuple[Check, ...] = ()
    within_m: _Distance | None = None

    def __post_init__(self) -> None:
        """Check that it says one thing."""
        if self.form not in FORMS:
            raise ValueError(f"a check is one of {_FORMS}")
        if self.within_m is not None and FORMS[self.form] is None:
            raise ValueError(f"within_m means nothing to {{{', '.join(sorted(self.form))}}}")
        try:
            patterns.check(self.said)
        except ValueError as error:
            raise ValueError(
                f"{shown(self.said)} is no regular expression of RE2: {error}"
            ) from None

    @property
    def form(self) -> frozenset[str]:
        """The names of what is given."""
        fields = msgspec.structs.fields(self)
        return frozenset(
            field.name
            for field in fields
            if field.name != "within_m" and getattr(self, field.name) != field.default
        )

    @property
    def distance_m(self) -> float:
        """The distance that counts; 0 where there is none."""
        return (FORMS[self.form] or 0.0) if self.within_m is None else self.within_m

    def names(self) -> Iterator[tuple[str, str]]:
        """Every name in it, with what it should be of."""
        yield from (("object", name) for name in (self.object, self.near, self.not_moved) if name)
        people = (self.with_person, self.robot_near, *self.passed)
        yield from (("person", name) for name in people if name)
        yield from (("room", name) for name in (self.robot_in, *self.visited) if name)
        yield from (("place", name) for name in (self.on,) if name)
        for check in self.any:
            yield from check.names()


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """How a run truly ended, and what was seen of it on the way where somebody watched.

    Attributes:
        wrong: each check that does not hold, in words; none: all is as it should be.
        upright: whether the robot truly stands on its feet.
        damped: whether the motors are left to damp by themselves.
        touched: what its body touched besides the floor, what it handles and what that stands on.
        too_near: the people whom it came too near while it walked.
    """

    wrong: tuple[str, ...]
    upright: bool
    damped: bool
    touched: tuple[str, ...] = ()
    too_near: tuple[str, ...] = ()
    source: str = "oracle"


def read(data: Sequence[Mapping[str, Any]], world_map: WorldMap) -> tuple[Check, ...]:
    """Checks out of plain data. Raises ConfigError with the nearest valid name."""
    checks = _checks(data)
    known = {
        "object": [item.id for item in world_map.objects],
        "person": [person.id for person in world_map.people],
        "room": [place.id for place in world_map.places if place.floor and place.room == place.id],
        "place": [
            name for place in world_map.places if not place.floor for name in (place.id, place.of)
        ],
    }
    problems = [
        Problem(f"unknown {kind} {shown(name)}", suggestion=config.nearest(name, known[kind]))
        for check in checks
        for kind, name in check.names()
        if name not in known[kind]
    ]
    if problems:
        raise ConfigError(problems[: config.MOST_PROBLEMS])
    return checks


def _checks(data: Sequence[Mapping[str, Any]]) -> tuple[Check, ...]:
    """Raises ConfigError with what is wrong, in the words of the file."""
    kind = tuple[Check, ...]
    problems = [
        Problem(f"a check of the truth: {misfit.message}", suggestion=misfit.cure)
        for misfit in islice(misfits(list(data), kind), config.MOST_PROBLEMS)
    ]
    if problems:
        raise ConfigError(problems)
    try:
        return msgspec.convert(list(data), kind)
    except msgspec.ValidationError as error:  # what a check looks at by itself
        message, _, _ = str(error).partition(" - at `")
        raise ConfigError([Problem(f"a check of the truth: {message}")]) from None
