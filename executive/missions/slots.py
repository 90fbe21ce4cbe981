"""The slots of a step to a goal: what the texts in it name, each looked up where it stands."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from msgspec.structs import replace

from executive.missions import schema as s
from executive.missions.names import Names
from executive.missions.problems import Problems
from intents import goals
from robot.files.yaml_nodes import Node, text_node


class Missing(Exception):
    """A slot means nothing; its problem is noted. Never leaves `Slots.goal`."""


class Slots:
    """Makes goals of steps."""

    def __init__(self, names: Names, problems: Problems) -> None:
        """Look texts up in `names`; what is wrong goes to `problems`."""
        self._names = names
        self._problems = problems
        self._looks: dict[str, Callable[[Node, Problems], object]] = {
            "object": names.object, "person": names.person, "place": names.place,
            "at": names.place, "on": names.place, "in_": names.place, "to": self._receiver,
        }  # fmt: skip

    def goal(self, key: str, record: s.StepRecord, node: Node) -> goals.Goal | None:
        """The goal of a step that is known by `key`; None if a slot is wrong.

        Args:
            key: the step's kind.
            record: the step as it was read.
            node: its mapping, for the places of what is wrong.
        """
        value = getattr(record, key)
        where = node.get(key) or node
        try:
            return _GOALS[key](self, value, where)
        except Missing:
            self._look_at_the_rest(value, where)
            return None

    def _look_at_the_rest(self, value: object, where: Node) -> None:
        """Look every name up in a step one of whose slots is wrong."""
        for key, look_up in self._looks.items():
            text = getattr(value, key, None)
            if isinstance(text, str) and where.kind == "map":
                look_up(_at(where, key.rstrip("_"), text), self._problems)

    def look(self, where: Node, fill: Callable[[Node], Node | None]) -> None:
        """Look every name up in a step that could not be read.

        Args:
            where: the mapping of its slots.
            fill: fills parameters in; None where one is wrong, which is noted already.
        """
        for key, look_up in self._looks.items():
            slot = where.get(key.rstrip("_")) if where.kind == "map" else None
            named = fill(slot) if slot is not None and slot.kind == "text" else None
            if named is not None:
                look_up(named, self._problems)

    def _receiver(self, node: Node, problems: Problems) -> object:
        is_person = self._names.is_person(node.text) and not self._names.is_place(node.text)
        return None if is_person else self._names.place(node, problems)

    # --- looking up ---

    def _object(self, text: str, where: Node, key: str, at: str | None = None) -> goals.ObjectQuery:
        query = self._need(self._names.object(_at(where, key, text), self._problems))
        if at is None:
            return query
        return replace(query, at=self._place(at, where, "at"))

    def _place(self, text: str, where: Node, key: str) -> str:
        return self._need(self._names.place(_at(where, key, text), self._problems))

    def _person(self, text: str, where: Node, key: str) -> goals.Person:
        return self._need(self._names.person(_at(where, key, text), self._problems))

    def _need(self, found: Any) -> Any:
        if found is None:
            raise Missing
        return found

    def _one_of(self, slots: s.Record, where: Node, *keys: str) -> str:
        given = [key for key in keys if getattr(slots, key) is not None]
        if len(given) != 1:
            known, said = (", ".join(key.rstrip("_") for key in some) for some in (keys, given))
            text = f"exactly one of {known} should stand here"
            self._problems.add(where, text, f"given: {said or 'none'}")
            raise Missing
        return given[0]

    # --- goals ---

    def _go_to(self, value: str | s.GoToSlots, where: Node) -> goals.Goal:
        if isinstance(value, str):
            if self._names.is_person(value) and not self._names.is_place(value):
                return goals.GoTo(place=goals.OPERATOR if value == "me" else value)
            return goals.GoTo(place=self._place(value, where, ""))
        key = self._one_of(value, where, "place", "person", "pose", "by")
        if value.place is not None:
            return goals.GoTo(place=self._place(value.place, where, key))
        if value.person is not None:
            person = self._person(value.person, where, key)
            return goals.GoTo(place=person.name or goals.OPERATOR)
        if value.pose is not None:
            yaw_rad = self._angle(value.pose.yaw_rad, value.pose.yaw_deg, where, "yaw")
            pose = goals.Pose2(x_m=_float(value.pose.x_m), y_m=_float(value.pose.y_m),
                               yaw_rad=yaw_rad)  # fmt: skip
            return goals.GoTo(pose=pose)
        assert value.by is not None
        if value.by == s.DisplacementSlots():
            cure = "for example: {forward_m: 0.5}"
            self._problems.add(where, "by says neither how far nor how much to turn", cure)
            raise Missing
        turn_rad = self._angle(value.by.turn_rad, value.by.turn_deg, where, "turn")
        by = goals.Displacement(
            forward_m=_maybe(value.by.forward_m), left_m=_maybe(value.by.left_m), turn_rad=turn_rad
        )
        return goals.GoTo(by=by)

    def _angle(
        self, rad: s.Number | None, deg: s.Number | None, where: Node, name: str
    ) -> float | None:
        if rad is not None and deg is not None:
            self._problems.add(where, f"either {name}_rad or {name}_deg", "leave one of them out")
            raise Missing
        return math.radians(_float(deg)) if deg is not None else _maybe(rad)

    def _find(self, value: str | s.TargetSlots, where: Node) -> goals.Goal:
        if isinstance(value, str):
            if self._names.is_person(value):
                return goals.Find(person=self._person(value, where, ""))
            return goals.Find(object=self._object(value, where, ""))
        self._one_of(value, where, "object", "person")
        if value.person is not None:
            return goals.Find(person=self._person(value.person, where, "person"))
        return goals.Find(object=self._object(value.object or "", where, "object", value.at))

    def _look_at(self, value: str | s.TargetSlots, where: Node) -> goals.Goal:
        if isinstance(value, str):
            if self._names.is_place(value):
                return goals.LookAt(place=self._place(value, where, ""))
            if self._names.is_person(value):
                return goals.LookAt(person=self._person(value, where, ""))
            return goals.LookAt(object=self._object(value, where, ""))
        self._one_of(value, where, "object", "person", "place")
        if value.place is not None:
            return goals.LookAt(place=self._place(value.place, where, "place"))
        if value.person is not None:
            return goals.LookAt(person=self._person(value.person, where, "person"))
        return goals.LookAt(object=self._object(value.object or "", where, "object", value.at))

    def _pick(self, value: str | s.ObjectSlots, where: Node) -> goals.Goal:
        return goals.Pick(object=self._thing(value, where))

    def _count(self, value: str | s.ObjectSlots, where: Node) -> goals.Goal:
        return goals.Count(object=self._thing(value, where))

    def _thing(self, value: str | s.ObjectSlots, where: Node) -> goals.ObjectQuery:
        if isinstance(value, str):
            return self._object(value, where, "")
        return self._object(value.object, where, "object", value.at)

    def _put(self, value: s.PlaceSlots, where: Node) -> goals.Goal:
        key = self._one_of(value, where, "on", "in_")
        thing = self._object(value.object, where, "object")
        place = self._place(getattr(value, key), where, key.rstrip("_"))
        if key == "on":
            return goals.Place(object=thing, on=place)
        return goals.Place(object=thing, in_=place)

    def _bring(self, value: s.BringSlots, where: Node) -> goals.Goal:
        thing = self._object(value.object, where, "object", value.at)
        if self._names.is_person(value.to) and not self._names.is_place(value.to):
            return goals.Bring(object=thing, to=self._person(value.to, where, "to"))
        return goals.Bring(object=thing, to=self._place(value.to, where, "to"))

    def _greet(self, value: str | s.PersonSlots, where: Node) -> goals.Goal:
        return goals.Greet(person=self._whom(value, where))

    def _meet(self, value: str | s.PersonSlots, where: Node) -> goals.Goal:
        return goals.Meet(person=self._whom(value, where))

    def _whom(self, value: str | s.PersonSlots, where: Node) -> goals.Person:
        if isinstance(value, str):
            return self._person(value, where, "")
        return self._person(value.person, where, "person")

    def _say(self, value: str, _where: Node) -> goals.Goal:
        return goals.Say(what=value)

    def _balance(self, value: Any, _where: Node) -> goals.Goal:
        if isinstance(value, str):
            return goals.Balance(mode=value)  # pyright: ignore[reportArgumentType]
        duration_s = _maybe(value.duration_s)
        return goals.Balance(mode=value.mode, side=value.side, duration_s=duration_s)

    def _wait(self, value: Any, _where: Node) -> goals.Goal:
        wait_s = value.duration_s if isinstance(value, s.WaitSlots) else value
        return goals.Wait(duration_s=_float(wait_s))

    def _report(self, value: Any, _where: Node) -> goals.Goal:
        return goals.Report(topic=value)

    TABLE: ClassVar[dict[str, Callable[[Slots, Any, Node], goals.Goal]]] = {
        "go_to": _go_to,
        "find": _find,
        "pick": _pick,
        "place": _put,
        "bring": _bring,
        "look_at": _look_at,
        "greet": _greet,
        "meet": _meet,
        "say": _say,
        "count": _count,
        "balance": _balance,
        "wait": _wait,
        "report": _report,
    }


_GOALS = Slots.TABLE


def _at(where: Node, key: str, text: str) -> Node:
    """A text in the place of the slot that it comes from."""
    slot = where.get(key) if key and where.kind == "map" else None
    return text_node(text, slot or where)


def _float(value: s.Number) -> float:
    """A number; parameters are filled in by now."""
    return float(value)


def _maybe(value: s.Number | None) -> float | None:
    return None if value is None else float(value)
