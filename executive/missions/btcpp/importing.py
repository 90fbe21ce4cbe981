"""A BehaviorTree.CPP tree to a mission; what has no equivalent is refused by name and line.

SubTrees are written out where they are called, with the values of their ports. A blackboard entry
that no port gives a value has none here either.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias, cast

import msgspec

from executive.missions.btcpp import leaves
from executive.missions.btcpp.xml import Element, read
from executive.missions.compiling import MAX_STEPS
from robot import yaml_nodes
from robot.config import nearest

Step: TypeAlias = Any
Ports: TypeAlias = dict[str, str]
JSON = "json:"
"""Before a condition that is no sentence; a brace alone would be a blackboard entry."""
NOTHING: dict[str, Any] = {"do": []}
OPTIONS = ("retry", "timeout_s", "on_fail", "always")


def mission_of(path: Path) -> str:
    """The text of a mission that does what a tree says.

    Raises:
        ConfigError: the file is wrong, or something in it has no equivalent.
    """
    return yaml_nodes.dump(mission_data(read(path), file_name=path.stem))


def mission_data(root: Element, *, file_name: str = "imported") -> dict[str, Any]:
    """The same as plain data; `file_name` is for a tree without a name."""
    if root.tag != "root":
        raise root.wrong(f"<{root.tag}> is no BehaviorTree.CPP file", "it begins with <root>")
    version = root.attributes.get("BTCPP_format", "3")
    if version != "4":
        cure = 'convert it, then say BTCPP_format="4"'
        raise root.wrong(f"format {version} of BehaviorTree.CPP is not read", cure)
    trees = {
        child.attributes.get("ID", ""): child
        for child in root.children
        if child.tag == "BehaviorTree"
    }
    if not trees:
        raise root.wrong("there is no <BehaviorTree> in it", "add one")
    main = root.attributes.get("main_tree_to_execute", next(iter(trees)))
    if main not in trees:
        raise root.wrong(f"there is no tree {main!r}", nearest(main, list(trees)))
    whole = _Importer(trees).tree(main, root, {})
    mission: dict[str, Any] = {"name": main or file_name}
    outside = _fields(whole)
    if "do" in outside and set(outside) <= {"do", "timeout_s", "always"}:
        if "timeout_s" in outside:
            mission["limits"] = {"duration_s": outside["timeout_s"]}
        if "always" in outside:
            mission["always"] = outside["always"]
        whole = {"do": outside["do"]}
    mission["steps"] = steps = _flat(whole)
    expected = _expected(steps)
    if expected:
        mission["expect"] = expected
    if not steps:
        raise root.wrong(f"the tree {main!r} does nothing", "add a leaf")
    return mission


def _expected(steps: list[Step]) -> list[Any]:
    """What the last steps expect; they become the mission's `expect`."""
    found: list[Any] = []
    while steps and "expect" in _fields(steps[-1]):
        found.insert(0, steps.pop()["expect"])
    return found


class _Importer:
    """Writes trees out as steps."""

    def __init__(self, trees: dict[str, Element]) -> None:
        self._trees = trees
        self._calls: list[str] = []
        self._count = 0

    def tree(self, name: str, caller: Element, ports: Ports) -> Step:
        """A tree that is called with some ports, as one step."""
        if name in self._calls:
            chain = " > ".join([*self._calls[self._calls.index(name) :], name])
            raise caller.wrong(f"this tree calls itself: {chain}", "use Repeat")
        tree = self._trees[name]
        if len(tree.children) != 1:
            raise tree.wrong(f"the tree {name!r} has {len(tree.children)} roots", "it takes one")
        self._calls.append(name)
        step = self.step(tree.children[0], ports)
        self._calls.pop()
        return step

    def step(self, element: Element, ports: Ports) -> Step:
        """What an element becomes."""
        self._count += 1
        if self._count > MAX_STEPS:
            raise element.wrong(f"more than {MAX_STEPS} nodes, SubTrees written out", "")
        attributes = self._attributes(element, ports)
        kind = attributes.get("ID", "") if element.tag in _KINDS else element.tag
        make = _NODES.get(kind)
        if make is not None:
            return make(self, element, attributes, ports)
        if kind in _REFUSED:
            raise element.wrong(f"{kind} has no equivalent: {_REFUSED[kind]}", "")
        if element.children:
            raise element.wrong(f"{kind} has no equivalent", nearest(kind, sorted(_NODES)))
        return leaves.step_of(element, attributes)

    def _attributes(self, element: Element, ports: Ports) -> dict[str, str]:
        """The attributes with the values of the ports in them."""
        found: dict[str, str] = {}
        for key, text in element.attributes.items():
            if key.startswith("_") and key != "_autoremap":
                raise element.wrong(f"the condition {key!r} has no equivalent", "use IfThenElse")
            entry = re.fullmatch(r"\{(\w+)\}", text)
            if entry is None:
                found[key] = text
            elif entry[1] in ports:
                found[key] = ports[entry[1]]
            else:
                cure = "give it a value as a port of the SubTree"
                raise element.wrong(f"the blackboard entry {text} has no value", cure)
        return found

    # --- nodes ---

    def children(self, element: Element, ports: Ports) -> list[Step]:
        """The steps of an element's children."""
        steps = [self.step(child, ports) for child in element.children]
        return [step for step in steps if step != NOTHING]

    def only(self, element: Element, ports: Ports) -> Step:
        """The step of a decorator's one child."""
        if len(element.children) != 1:
            count = len(element.children)
            raise element.wrong(f"{element.tag} takes one child, not {count}", "use Sequence")
        return self.step(element.children[0], ports)

    def sequence(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """One after the other."""
        if not element.children:
            raise element.wrong(f"{element.tag} without children", "add one")
        return _named({"do": self.children(element, ports)}, attributes)

    def fallback(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """One after the other until one succeeds."""
        if not element.children:
            raise element.wrong("Fallback without children", "add one")
        *others, step = [self.step(child, ports) for child in element.children]
        for other in reversed(others):
            step = {"do": _flat(other), "on_fail": {"any": _flat(step)}}
        return _named(_fields(step), attributes) if _fields(step) else step

    def parallel(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """All at the same time."""
        count = len(element.children)
        wanted = attributes.get("success_count", attributes.get("success_threshold", "-1"))
        failed = attributes.get("failure_count", attributes.get("failure_threshold", "1"))
        most = attributes.get("max_failures", "1")
        if wanted not in ("-1", str(count)) or failed != "1" or most not in ("0", "1"):
            text = f"{element.tag} that does not wait for all its {count} children"
            cure = 'success_count="-1" failure_count="1"'
            raise element.wrong(f"{text} has no equivalent", cure)
        branches = [
            _flat(step) if set(_fields(step)) == {"do"} else step
            for step in self.children(element, ports)
        ]
        return _named({"parallel": branches}, attributes)

    def retry(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Again, until it succeeds."""
        attempts = _whole(element, attributes, "num_attempts")
        step = self.only(element, ports)
        return step if attempts == 1 else _with(step, "retry", attempts - 1)

    def repeat(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Again, so many times."""
        cycles = _whole(element, attributes, "num_cycles")
        step = self.only(element, ports)
        return _named({"repeat": cycles, "do": _flat(step)}, attributes)

    def timeout(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Not longer than that."""
        limit_s = _whole(element, attributes, "msec") / 1000.0
        return _with(self.only(element, ports), "timeout_s", limit_s)

    def delay(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Some time later."""
        wait_s = _whole(element, attributes, "delay_msec") / 1000.0
        return {"do": [{"wait": wait_s}, self.only(element, ports)]}

    def force_success(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """Whether it succeeds or not."""
        return _with(self.only(element, ports), "on_fail", {"any": []})

    def inverter(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """The other way round: of conditions only."""
        (child,) = element.children if len(element.children) == 1 else (element,)
        if child.tag not in _CONDITIONS:
            raise element.wrong("Inverter of an action has no equivalent", "invert a condition")
        return _checked({"not": self.condition(child, ports)})

    def if_then_else(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """One or the other."""
        if len(element.children) not in (2, 3):
            raise element.wrong("IfThenElse takes two or three children", "")
        asked, *others = element.children
        branches = [_flat(self.step(child, ports)) for child in others]
        found: dict[str, Any] = {"if": self.condition(asked, ports), "then": branches[0]}
        if len(branches) > 1:
            found["else"] = branches[1]
        return _named(found, attributes)

    def subtree(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Another tree, with its ports."""
        name = attributes.get("ID", "")
        if name not in self._trees:
            raise element.wrong(f"there is no tree {name!r}", nearest(name, list(self._trees)))
        remapped = {k: v for k, v in attributes.items() if k not in ("ID", "name", "_autoremap")}
        inherited = ports if attributes.get("_autoremap") in ("1", "true") else {}
        steps = self.tree(name, element, {**inherited, **remapped})
        return _named({"do": _flat(steps)}, attributes)

    def check(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """A condition among actions: it fails where it does not hold."""
        if element.tag == "Expect":
            return {"expect": self.condition(element, ports)}
        return _named(_checked(self.condition(element, ports)), attributes)

    def nothing(self, _element: Element, _attributes: Ports, _ports: Ports) -> Step:
        """Success at once."""
        return NOTHING

    def failing(self, _element: Element, _attributes: Ports, _ports: Ports) -> Step:
        """Failure at once."""
        return {"fail": "always fails"}

    # --- our own nodes, as exported ---

    def on_fail(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """The first child; when it fails, the child of its code."""
        first, *handlers = [self.step(child, ports) for child in element.children] or [None]
        codes = attributes.get("codes", "").split(";")
        if first is None or len(codes) != len(handlers):
            raise element.wrong("OnFail takes a child, and one for each code", "")
        steps = [_flat(handler) for handler in handlers]
        return _with(first, "on_fail", dict(zip(codes, steps, strict=True)))

    def always(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """The first child, then the second in any case."""
        if len(element.children) != 2:
            raise element.wrong("Always takes two children", "")
        first, after = (self.step(child, ports) for child in element.children)
        return _with(first, "always", _flat(after))

    def while_(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """As long as a condition holds."""
        at_most = _whole(element, attributes, "at_most")
        found = {"while": _condition(attributes), "at_most": at_most}
        return _named({**found, "do": _flat(self.only(element, ports))}, attributes)

    def condition(self, element: Element, ports: Ports) -> Any:
        """The condition that an element states."""
        attributes = self._attributes(element, ports)
        if element.tag == "Inverter" and len(element.children) == 1:
            return {"not": self.condition(element.children[0], ports)}
        kind = attributes.get("ID", "") if element.tag in _KINDS else element.tag
        if kind not in _CONDITIONS:
            raise element.wrong(f"the condition {kind!r} has no equivalent",
                                nearest(kind, sorted(_CONDITIONS)))  # fmt: skip
        return _CONDITIONS[kind](attributes)


def _whole(element: Element, attributes: Ports, key: str) -> int:
    text = attributes.get(key, "")
    if not re.fullmatch(r"[0-9]{1,9}", text) or int(text) == 0:
        message = f"{element.tag} with {key}={text!r} has no equivalent"
        raise element.wrong(message, "a whole number from 1: nothing here is without an end")
    return int(text)


def _named(step: dict[str, Any], attributes: Ports) -> Step:
    return {**step, "name": attributes["name"]} if "name" in attributes else step


def _flat(step: Step) -> list[Step]:
    """A step as a list of steps."""
    fields = _fields(step)
    return fields["do"] if set(fields) == {"do"} else [step]


def _fields(step: Step) -> dict[str, Any]:
    """The keys of a step that is a mapping."""
    return cast("dict[str, Any]", step) if isinstance(step, dict) else {}


def _with(step: Step, option: str, value: Any) -> Step:
    """A step with one more option; options have their order, so it may have to be wrapped."""
    order = OPTIONS.index(option)
    fields = _fields(step)
    plain = fields and not any(key in fields for key in OPTIONS[order:])
    inner = fields if plain else {"do": [step]}
    return {**inner, option: value}


def _checked(condition: Any) -> Step:
    return {"if": condition, "then": [], "else": [{"fail": f"not so: {_words(condition)}"}]}


def _words(condition: Any) -> str:
    return condition if isinstance(condition, str) else msgspec.json.encode(condition).decode()


def _condition(attributes: Ports) -> Any:
    text = attributes.get("condition", "")
    return msgspec.json.decode(text[len(JSON) :]) if text.startswith(JSON) else text


Make = Callable[[_Importer, Element, Ports, Ports], Step]

_KINDS = ("Action", "Condition", "Control", "Decorator")
_NODES: dict[str, Make] = {
    "Sequence": _Importer.sequence,
    "SequenceWithMemory": _Importer.sequence,
    "Fallback": _Importer.fallback,
    "Parallel": _Importer.parallel,
    "ParallelAll": _Importer.parallel,
    "RetryUntilSuccessful": _Importer.retry,
    "Repeat": _Importer.repeat,
    "Timeout": _Importer.timeout,
    "Delay": _Importer.delay,
    "ForceSuccess": _Importer.force_success,
    "Inverter": _Importer.inverter,
    "IfThenElse": _Importer.if_then_else,
    "SubTree": _Importer.subtree,
    "AlwaysSuccess": _Importer.nothing,
    "AlwaysFailure": _Importer.failing,
    "OnFail": _Importer.on_fail,
    "Always": _Importer.always,
    "While": _Importer.while_,
    "Check": _Importer.check,
    "Expect": _Importer.check,
    "IsSeen": _Importer.check,
    "IsHolding": _Importer.check,
    "IsAt": _Importer.check,
}
_CONDITIONS: dict[str, Callable[[Ports], Any]] = {
    "Check": _condition,
    "Expect": _condition,
    "IsSeen": lambda ports: {"seen": ports.get("object", ""), **_some(ports, "on")},
    "IsHolding": lambda ports: {"holding": ports.get("object", True)},
    "IsAt": lambda ports: {"robot_at": ports.get("place", "")},
}
_REFUSED: dict[str, str] = {
    "ReactiveSequence": "conditions are asked once here, not at every tick",
    "ReactiveFallback": "conditions are asked once here, not at every tick",
    "WhileDoElse": "conditions are asked once here, not at every tick",
    "KeepRunningUntilFailure": "it has no end",
    "RunOnce": "a mission is run once",
    "ForceFailure": "nothing fails on purpose after it succeeded",
    "Script": "nothing is computed in a mission",
    "ScriptCondition": "nothing is computed in a mission",
    "SetBlackboard": "a mission has parameters, and no variables",
    "UnsetBlackboard": "a mission has parameters, and no variables",
    "Precondition": "nothing is computed in a mission",
    "LoopString": "use for_each",
    "LoopInt": "use for_each",
    "LoopDouble": "use for_each",
    **{f"Switch{n}": "use if" for n in range(2, 7)},
}
"""Nodes of BehaviorTree.CPP that cannot be meant here, and why."""


def _some(ports: Ports, *keys: str) -> dict[str, str]:
    return {key: ports[key] for key in keys if key in ports}
