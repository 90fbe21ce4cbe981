"""Missions that are called: found, read once, and given the values of their parameters."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from executive.missions.load import Mission, load
from executive.missions.names import Names
from executive.missions.problems import Problems
from executive.missions.values import Bound, Scope, bind
from robot.errors import ConfigError
from robot.files.config import nearest
from robot.files.yaml_nodes import Node, text_node

MAX_CALLS = 16
"""Missions inside missions."""


class Calls:
    """The missions under way, each called by the one before it, and the files of all."""

    def __init__(self, names: Names, problems: Problems) -> None:
        """Note problems in `problems`."""
        self._names = names
        self._problems = problems
        self._files: dict[Path, Mission | None] = {}
        self._under_way: list[Path] = []

    @property
    def files(self) -> tuple[Path, ...]:
        """The missions that are called."""
        return tuple(mission.path for mission in self._files.values() if mission is not None)

    @property
    def nested(self) -> bool:
        """Whether the mission under way is called by another."""
        return len(self._under_way) > 1

    @contextmanager
    def inside(self, mission: Mission) -> Generator[None]:
        """What is called inside the block is called by this mission."""
        self._under_way.append(mission.path.resolve())
        yield
        self._under_way.pop()

    def called(self, where: Node) -> Mission | None:
        """The mission that a step calls, unless it would never end."""
        path = Path(where.file).parent / where.text
        if path.name in ("", "..") or not Path(where.text).name:
            self._problems.add(where, f"{where.text!r} names no file", "name a mission beside this")
            return None
        if not path.suffix:
            path = path.with_suffix(".yaml")
        real = path.resolve()
        if real in self._under_way:
            chain = [*self._under_way[self._under_way.index(real) :], real]
            text = "this mission calls itself: " + " > ".join(link.name for link in chain)
            self._problems.add(where, text, "leave the step out, or use repeat")
            return None
        if len(self._under_way) >= MAX_CALLS:
            self._problems.add(where, f"missions inside missions: at most {MAX_CALLS}", "")
            return None
        if real not in self._files:
            self._files[real] = self._load(path, where)
        return self._files[real]

    def _load(self, path: Path, where: Node) -> Mission | None:
        try:
            return load(path, self._problems)
        except ConfigError as error:
            for problem in error.problems:
                if problem.line is None:
                    near = [other.stem for other in path.parent.glob("*.yaml")][:200]
                    cure = nearest(path.stem, near) if near else problem.suggestion or ""
                    self._problems.add(where, f"{path}: {problem.message}", cure)
                else:
                    place = Node("text", problem.file or "", problem.line, problem.column or 1)
                    self._problems.add(place, problem.message, problem.suggestion or "")
            return None

    # --- parameters ---

    def arguments(self, called: Mission, node: Node, scope: Scope, where: Node) -> dict[str, Bound]:
        """The values of a called mission's parameters: those of `with`, and defaults."""
        arguments = node.get("with")
        given = {
            name: filled
            for name, (_, value) in (arguments.entries if arguments else {}).items()
            if (filled := scope.fill(value) if value.kind == "text" else value) is not None
        }
        return self.bound(called, given, where=where)

    def bound(
        self, mission: Mission, given: dict[str, Node], *, where: Node, samples: bool = False
    ) -> dict[str, Bound]:
        """The values of a mission's parameters: given, or their defaults.

        Args:
            mission: whose parameters.
            given: values by name.
            where: the place of what is missing.
            samples: whether something fitting may stand in for what is missing.
        """
        found: dict[str, Bound] = {}
        declared = mission.record.parameters
        for name, node in given.items():
            if name not in declared:
                cure = nearest(name, list(declared)) if declared else "it has no parameters"
                text = f"the mission {mission.record.name!r} has no parameter {name!r}"
                self._problems.add(node, text, cure)
        for name, parameter in declared.items():
            node = given.get(name) or self._default(mission, name, samples=samples)
            if node is None:
                cure = f"--param {name}=..., or with: {{{name}: ...}}"
                text = f"the parameter {name!r} of {mission.record.name!r} has no value"
                self._problems.add(where, text, cure)
                continue
            value = bind(name, parameter, node, names=self._names, problems=self._problems)
            if value is not None:
                found[name] = value
        return found

    def _default(self, mission: Mission, name: str, *, samples: bool) -> Node | None:
        node = _descend(mission.node, "parameters", name)
        default = node.get("default") if node is not None else None
        if default is not None or not samples or node is None:
            return default
        value = self._names.sample(mission.record.parameters[name].type)
        return None if value is None else text_node(value, node, plain=True)


def _descend(node: Node, *keys: str) -> Node | None:
    found: Node | None = node
    for key in keys:
        found = found.get(key) if found is not None else None
    return found
