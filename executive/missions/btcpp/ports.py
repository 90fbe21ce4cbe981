"""The ports of nodes that are no leaves: which there are, and what a SubTree does with its own."""

from __future__ import annotations

from collections.abc import Mapping

from executive.missions.btcpp.steps import Ports
from executive.missions.btcpp.xml import Element
from robot.files.config import nearest

AUTOREMAP = ("_autoremap", "__autoremap", "__shared_blackboard")
OLDER: dict[str, str] = {
    "SequenceStar": "SequenceWithMemory",
    "RetryUntilSuccesful": "RetryUntilSuccessful",
    "SubTreePlus": "SubTree",
}
"""What nodes of format 3 are called since."""
_PORTS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(
        ("Parallel", "ParallelAll"),
        ("success_count", "success_threshold", "failure_count", "failure_threshold",
         "max_failures"),
    ),
    "RetryUntilSuccessful": ("num_attempts",),
    "Repeat": ("num_cycles",),
    "Timeout": ("msec",),
    "Delay": ("delay_msec",),
    "RecoveryNode": ("number_of_retries",),
    "NavigateToPose": ("goal",),
    "NavigateThroughPoses": ("goals",),
    "OnFail": ("codes",),
    "While": ("condition", "at_most"),
    "Check": ("condition",),
    "Expect": ("condition",),
    "IsSeen": ("object", "on"),
    "IsHolding": ("object",),
    "IsAt": ("place",),
}  # fmt: skip
"""What they read beside their ID and name; nodes that are not here read nothing."""
_ELSEWHERE = ("SubTree", "DriveOnHeading")
"""Nodes whose ports are looked over by whoever reads them."""


def check_ports(element: Element, kind: str, attributes: Ports) -> None:
    """Look for ports that a node does not have: nothing is dropped in silence.

    Raises:
        ConfigError: there is one.
    """
    known = _PORTS.get(kind, ())
    for port in attributes:
        if kind not in _ELSEWHERE and port not in ("ID", "name", *AUTOREMAP, *known):
            cure = nearest(port, sorted(known)) if known else "leave it out"
            raise element.wrong(f"the port {port!r} of {kind!r} has no equivalent", cure)


def shares_all(attributes: Mapping[str, str]) -> bool:
    """Whether a SubTree is given every entry of the tree that calls it."""
    return any(attributes.get(key) in ("1", "true") for key in AUTOREMAP)


def reads(
    trees: Mapping[str, Element],
    name: str,
    key: str,
    *,
    older: bool,
    above: frozenset[str] = frozenset(),
) -> bool:
    """Whether anything in a tree takes the value of a port, or hands it on.

    Args:
        trees: all there are, by name.
        name: of the tree.
        key: the port's name.
        older: whether they are of format 3, whose SubTrees name an entry without braces.
        above: trees that are looked through already.
    """
    elements = [*trees[name].children]
    for element in elements:
        elements += element.children
        given = element.attributes
        if f"{{{key}}}" in given.values():
            return True
        called = given.get("ID", "")
        if OLDER.get(element.tag, element.tag) != "SubTree" or called not in trees:
            continue
        if older and key in given.values():
            return True
        through = shares_all(given) and called not in {*above, name}
        if through and reads(trees, called, key, older=older, above=above | {name}):
            return True
    return False
