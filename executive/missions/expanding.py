"""A mission as plain data without parameters, calls and for_each: what other formats can hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from executive.missions.check import check
from executive.missions.compiling import Compiler
from executive.missions.load import Mission
from executive.missions.names import Names
from executive.missions.problems import Problems
from executive.missions.reading import Reader
from executive.missions.schema import ForEachStep
from executive.missions.values import Bound, Scope
from robot.files.yaml_nodes import Node, text_node
from robot.reality.contract import Reality


def expanded(path: Path, reality: Reality) -> dict[str, Any]:
    """A mission file's name, steps, always, expect and limits, all filled in and written out.

    Raises:
        ConfigError: with everything that is wrong in the file.
    """
    checked = check(path, reality)
    compiler = Compiler(Names(checked.where.knowledge), checked.where.description, Problems())
    return _Expander(compiler).mission(checked.mission, dict(checked.values))


class _Expander:
    """Writes out what was checked already."""

    def __init__(self, compiler: Compiler) -> None:
        self._compiler = compiler
        self._quiet = compiler.problems

    def mission(self, mission: Mission, bound: dict[str, Bound]) -> dict[str, Any]:
        """One mission."""
        scope = Scope(bound, self._quiet)
        node = mission.node
        found: dict[str, Any] = {"name": mission.record.name}
        if mission.record.limits.duration_s is not None:
            found["limits"] = {"duration_s": mission.record.limits.duration_s}
        for key in ("steps", "always", "expect"):
            items = node.get(key)
            if items is not None:
                found[key] = self._steps(items.items, scope)
        return found

    def _steps(self, nodes: list[Node], scope: Scope) -> list[Any]:
        return [self._step(node, scope) for node in nodes]

    def _step(self, node: Node, scope: Scope) -> Any:
        if node.kind != "map":
            return self._value(node, scope)
        if "for_each" in node.entries:
            return self._dressed({"do": self._for_each(node, scope)}, node, scope)
        if "mission" in node.entries:
            return self._dressed({"do": self._call(node, scope)}, node, scope)
        return self._value(node, scope)

    def _value(self, node: Node, scope: Scope) -> Any:
        """Any piece of a step, with its steps written out."""
        if node.kind == "text":
            filled = scope.fill(node) or node
            return filled.value if filled.kind == "text" else filled.plain_data
        if node.kind == "list":
            return self._steps(node.items, scope)
        return {key: self._value(value, scope) for key, (_, value) in node.entries.items()}

    def _dressed(self, core: dict[str, Any], node: Node, scope: Scope) -> dict[str, Any]:
        """The options of a step that was written out."""
        for key in ("name", "retry", "timeout_s", "on_fail", "always"):
            if key in node.entries:
                core[key] = self._value(node.entries[key][1], scope)
        return core

    def _for_each(self, node: Node, scope: Scope) -> list[Any]:
        record = Reader(self._quiet, scope.fill).record(node, ForEachStep)
        body = node.get("do")
        if record is None or body is None:
            return []
        values = self._compiler.each(record, node.entries["in"][1])
        rounds = [self._steps(body.items, scope.inside(record.for_each, v)) for v in values]
        return [step for steps in rounds for step in steps]

    def _call(self, node: Node, scope: Scope) -> list[Any]:
        where = text_node(str(self._value(node.entries["mission"][1], scope)),
                          node.entries["mission"][1])  # fmt: skip
        called = self._compiler.calls.called(where)
        if called is None:
            return []
        bound = self._compiler.calls.arguments(called, node, scope, where)
        inner = self.mission(called, bound)
        steps = [*inner["steps"], *map(_expected, inner.get("expect", ()))]
        core: dict[str, Any] = {"do": steps}
        if "limits" in inner:
            core["timeout_s"] = inner["limits"]["duration_s"]
        if inner.get("always"):
            core["always"] = inner["always"]
        return steps if set(core) == {"do"} else [core]


def _expected(condition: Any) -> dict[str, Any]:
    """What a mission that is called expects, as a step."""
    words = condition if isinstance(condition, str) else "as the mission expects"
    return {"if": condition, "then": [], "else": [{"fail": f"not so: {words}"}]}
