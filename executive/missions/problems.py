"""Everything that is wrong in a mission, collected with its place and its cure."""

from __future__ import annotations

from robot.errors import ConfigError, Problem
from robot.files.yaml_nodes import Node

ENOUGH = 100
"""More problems than that are not collected: nobody reads on."""


class Enough(Exception):
    """Ends the check of a file in which nearly everything is wrong; never leaves the check."""


class Problems:
    """A list of problems, each place and message once."""

    def __init__(self) -> None:
        """Begin with none."""
        self._found: dict[tuple[str, int, int, str], Problem] = {}

    def add(self, node: Node, message: str, suggestion: str = "") -> None:
        """Note a problem at a place.

        Raises:
            Enough: this one is the last that is worth noting.
        """
        key = (node.file, node.line, node.column, message)
        if key not in self._found:
            self._found[key] = node.problem(message, suggestion)
        if len(self._found) >= ENOUGH:
            raise Enough

    def take(self, error: ConfigError, node: Node) -> None:
        """Note what another reader found wrong; problems without a place get this one."""
        for problem in error.problems:
            self.add(node, problem.message, problem.suggestion or "")

    def take_here(self, error: ConfigError) -> None:
        """Note what is wrong in an error whose problems have their places."""
        for problem in error.problems:
            place = Node("text", problem.file or "", problem.line or 0, problem.column or 0)
            self.add(place, problem.message, problem.suggestion or "")

    @property
    def all(self) -> list[Problem]:
        """The problems in the order of their places."""
        return [self._found[key] for key in sorted(self._found)]

    def raise_any(self) -> None:
        """Raise them, if there are any.

        Raises:
            ConfigError: with all of them.
        """
        if self._found:
            raise ConfigError(self.all)

    def __len__(self) -> int:
        """How many there are."""
        return len(self._found)
