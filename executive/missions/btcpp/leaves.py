"""The table of leaves (`leaves.yaml`): a leaf's name to the step that it becomes, and back."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any, cast

import msgspec

from executive.missions.btcpp.xml import Element
from robot.files.config import load, nearest
from robot.files.yaml_nodes import resolve

TEXTS = ("object", "person", "place", "on", "in", "to", "at", "", "mode", "side")
"""Slots whose values stay texts, also where they look like numbers."""


class Leaf(msgspec.Struct, frozen=True, kw_only=True):
    """A leaf: the step that it becomes, and which slot each port fills.

    Attributes:
        step: its key.
        ports: the slot of each.
        defaults: what ports are taken to be that are not given.
        negative: ports whose values count as negative, whatever their sign.
        left_out: ports that change nothing here, each with the reason, which is told.
    """

    step: str
    ports: dict[str, str]
    defaults: dict[str, str] = {}
    negative: tuple[str, ...] = ()
    left_out: dict[str, str] = {}


@cache
def table() -> dict[str, Leaf]:
    """All leaves by name."""
    return load(Path(__file__).with_name("leaves.yaml"), dict[str, Leaf])


@cache
def refused() -> dict[str, str]:
    """Nodes that have no meaning here, each with the reason."""
    reasons = load(Path(__file__).with_name("refused.yaml"), dict[str, list[str]])
    return {name: reason for reason, names in reasons.items() for name in names}


@cache
def _by_step() -> dict[str, tuple[str, Leaf]]:
    found: dict[str, tuple[str, Leaf]] = {}
    for name, leaf in table().items():
        found.setdefault(leaf.step, (name, leaf))
    return found


def step_of(element: Element, attributes: dict[str, str]) -> Any:
    """The step of a leaf: a sentence, or a mapping.

    Raises:
        ConfigError: the leaf or one of its ports is not known.
    """
    name = attributes.get("ID", element.tag) if element.tag == "Action" else element.tag
    leaf = table().get(name)
    if leaf is None:
        cure = nearest(name, sorted(table()))
        raise element.wrong(f"the leaf {name!r} has no equivalent", cure)
    value: Any = {}
    for port, text in _given(leaf, name, element, attributes).items():
        value = _filled(value, leaf.ports[port], text, element)
        if port in leaf.negative:
            slots, slot = next(iter(value.values())), leaf.ports[port].rpartition(".")[2]
            number = slots[slot]
            slots[slot] = -abs(number) if isinstance(number, int | float) else number
    if leaf.step == "sentence":
        return value
    options = {"name": attributes["name"]} if "name" in attributes else {}
    return {leaf.step: value, **options}


def _given(leaf: Leaf, name: str, element: Element, attributes: dict[str, str]) -> dict[str, str]:
    """The ports that have a value, one for each slot."""
    found = {port: text for port, text in attributes.items() if port not in ("ID", "name")}
    taken: dict[str, str] = {}
    for port in found:
        if port not in leaf.ports:
            cure = nearest(port, sorted(leaf.ports))
            raise element.wrong(f"the port {port!r} of {name!r} has no equivalent", cure)
        slot = leaf.ports[port].partition(" * ")[0]
        other = taken.get(slot) or (next(iter(taken.values()), "") if not slot else taken.get(""))
        if other:
            text = f"the ports {other!r} and {port!r} of {name!r} say the same"
            raise element.wrong(text, "leave one of them out")
        taken[slot] = port
    defaults = {k: v for k, v in leaf.defaults.items() if leaf.ports[k] not in taken}
    return {**defaults, **found}


def _filled(value: Any, slot: str, text: str, element: Element) -> Any:
    """Put a port's text into a slot, such as `pose.x_m` or `duration_s * 0.001`."""
    slot, _, factor = slot.partition(" * ")
    last = slot.rpartition(".")[2]
    if not text.strip():
        raise element.wrong(f"a port of {element.tag} is empty", "give it a value")
    said = last in TEXTS
    found: Any = text if said else resolve(text)
    if isinstance(found, str) and not said and re.fullmatch(r"[-+0-9.eE]*[0-9][-+0-9.eE]*", found):
        raise element.wrong(f"{found[:40]!r} is no number that can be meant", "a smaller one")
    if factor:
        if not isinstance(found, int | float):
            raise element.wrong(f"{text[:40]!r} should be a number")
        found = found * float(factor)
    if not slot:
        return found
    inner = value
    *outer, last = slot.split(".")
    for key in outer:
        inner = inner.setdefault(key, {})
    inner[last] = found
    return value


def leaf_of(step: str, value: Any) -> tuple[str, dict[str, str]]:
    """The leaf's name and ports of a step."""
    name, leaf = _by_step()[step]
    if not isinstance(value, dict):  # the short form
        port = next((port for port, slot in leaf.ports.items() if slot == ""), None)
        return name, {port or _main(leaf): _text(value)}
    ports: dict[str, str] = {}
    for port, slot in leaf.ports.items():
        found: Any = cast("Any", value)
        for key in slot.split("."):
            fields = cast("dict[str, Any]", found) if isinstance(found, dict) else {}
            found = fields.get(key)
        if found is not None and slot not in [leaf.ports[other] for other in ports]:
            ports[port] = _text(found)
    return name, ports


def _main(leaf: Leaf) -> str:
    """The port that a step's short form fills."""
    return next(iter(leaf.ports))


def _text(value: Any) -> str:
    return repr(value) if isinstance(value, float) else str(value)
