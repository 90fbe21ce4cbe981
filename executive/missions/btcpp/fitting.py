"""Steps that an import makes, held against what a mission may hold where each is made.

So a mistake is told by the line of the tree, and not by that of the mission which it became.
"""

from __future__ import annotations

import re
from typing import cast

from executive.missions.btcpp import leaves
from executive.missions.btcpp.steps import Ports, Step, fields
from executive.missions.btcpp.xml import Element
from executive.missions.problems import Problems
from executive.missions.reading import Reader
from executive.missions.schema import STEPS
from robot.errors import ConfigError, Problem
from robot.files.yaml_nodes import Node, of_data

STUB = "a step"
_INSIDE = ("do", "then", "else", "always", "parallel", "on_fail")
"""Keys that hold steps, each of which was held against its own type when it was made."""


def check(element: Element, kind: str, attributes: Ports, step: Step) -> None:
    """Hold a step against its type, not the steps inside it.

    Raises:
        ConfigError: it would not pass the check of a mission: all of it, at the element.
    """
    given = fields(step)
    key = next((key for key in STEPS if key in given), None)
    if key is None:
        return
    shallow = {k: _stub(value) if k in _INSIDE else value for k, value in given.items()}
    place = Node("text", element.file, element.line, 0)
    problems = Problems()
    Reader(problems, lambda node: node).record(of_data(shallow, place), STEPS[key])
    if len(problems):
        found = [_in_ports(problem, kind, attributes, element) for problem in problems.all]
        raise ConfigError(found)


def _stub(value: object) -> object:
    """Steps, without what is in them."""
    if isinstance(value, dict):
        return {key: _stub(one) for key, one in cast("dict[str, object]", value).items()}
    return [STUB for _ in cast("list[object]", value)]


def _in_ports(problem: Problem, kind: str, attributes: Ports, element: Element) -> Problem:
    """A problem of a step in the words of its element: slots by the names of their ports."""
    text, cure = problem.message, problem.suggestion
    missing = re.fullmatch(r"the key '(\w+)' is missing", text)
    leaf = leaves.table().get(kind)
    for port, slot in leaf.ports.items() if leaf is not None else ():
        name = slot.partition(" * ")[0].rpartition(".")[2]
        if missing and missing[1] == name:
            text, cure = f"the port {port!r} is missing", f'{port}="..."'
            break
        if port in attributes and name:
            text = re.sub(rf"^{name}\b", port, text)
    return Problem(f"{kind}: {text}", element.file, element.line, None, cure)
