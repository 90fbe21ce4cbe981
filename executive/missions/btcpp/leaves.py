"""The table of leaves (`leaves.yaml`): a leaf's name to the step that it becomes, and back."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any, cast

import msgspec

from executive.missions.btcpp.xml import Element
from robot.config import load, nearest
from robot.yaml_nodes import resolve

TEXTS = ("object", "person", "place", "on", "in", "to", "at", "", "mode", "side")
"""Slots whose values stay texts, also where they look like numbers."""


class Leaf(msgspec.Struct, frozen=True, kw_only=True):
    """A leaf: the step that it becomes, and which slot each port fills."""

    step: str
    ports: dict[str, str]


@cache
def table() -> dict[str, Leaf]:
    """All leaves by name."""
    return load(Path(__file__).with_name("leaves.yaml"), dict[str, Leaf])


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
    for port, text in attributes.items():
        if port in ("ID", "name"):
            continue
        if port not in leaf.ports:
            cure = nearest(port, sorted(leaf.ports))
            raise element.wrong(f"the port {port!r} of {name!r} has no equivalent", cure)
        value = _filled(value, leaf.ports[port], text, element)
    if leaf.step == "sentence":
        return value
    options = {"name": attributes["name"]} if "name" in attributes else {}
    return {leaf.step: value, **options}


def _filled(value: Any, slot: str, text: str, element: Element) -> Any:
    """Put a port's text into a slot, such as `pose.x_m` or `duration_s * 0.001`."""
    slot, _, factor = slot.partition(" * ")
    last = slot.rpartition(".")[2]
    found: Any = text if last in TEXTS else resolve(text)
    if factor:
        if not isinstance(found, int | float):
            raise element.wrong(f"{text!r} should be a number")
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
