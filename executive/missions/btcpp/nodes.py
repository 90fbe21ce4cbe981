"""The nodes of BehaviorTree.CPP as steps: a method each, and one table of their names."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from executive.missions.btcpp import fitting, leaves
from executive.missions.btcpp.ports import AUTOREMAP, OLDER, check_ports, reads, shares_all
from executive.missions.btcpp.poses import poses_of
from executive.missions.btcpp.steps import (
    NOTHING,
    Ports,
    Step,
    checked,
    condition_in,
    fields,
    flat,
    named,
    number_in,
    one_of,
    whole,
    with_option,
)
from executive.missions.btcpp.xml import MAX_DEPTH, Element
from executive.missions.compiling import MAX_STEPS
from executive.missions.problems import Enough, Problems
from executive.missions.schema import MAX_ROUNDS, MAX_TRIES
from robot.errors import ConfigError
from robot.files.config import nearest

MAX_RECOVERIES = 5
"""In one another; what is in them is written out two to that power times."""
_FOR_PEOPLE = ("_description", "_uid", "_fullpath")
"""What Groot2 writes."""


class Importer:
    """Writes trees out as steps, each where it is called."""

    def __init__(
        self, trees: dict[str, Element], problems: Problems, notes: list[str], *, older: bool
    ) -> None:
        """Write nothing yet; `called` are the trees that were written, `expected` its Expects.

        Args:
            trees: by name, those that can be called.
            problems: takes what has no equivalent.
            notes: takes what was left out, a line each.
            older: whether they are of format 3.
        """
        self._trees = trees
        self._problems = problems
        self._notes = notes
        self._older = older
        self.called: set[str] = set()
        self.expected: list[tuple[Element, Step]] = []
        self._seen: set[int] = set()
        self._recoveries = 0
        self._calls: list[str] = []
        self._count = self._depth = 0

    def tree(self, name: str, caller: Element, ports: Ports) -> Step:
        """A tree that is called with some ports, as one step."""
        if name in self._calls:
            chain = " > ".join([*self._calls[self._calls.index(name) :], name])
            raise caller.wrong(f"this tree calls itself: {chain}", "use Repeat")
        tree = self._trees[name]
        if len(tree.children) != 1:
            raise tree.wrong(f"the tree {name!r} has {len(tree.children)} roots", "it takes one")
        self._calls.append(name)
        self.called.add(name)
        step = self.step(tree.children[0], ports)
        self._calls.pop()
        return step

    def step(self, element: Element, ports: Ports) -> Step:
        """What an element becomes; nothing if that cannot be, which is noted."""
        self._seen.add(id(element))
        if self._depth == MAX_DEPTH:
            text = f"nested deeper than {MAX_DEPTH} levels, SubTrees written out"
            self._problems.take_here(element.wrong(text, "make it flatter"))
            return NOTHING
        self._depth += 1
        try:
            return self._step(element, ports)
        except ConfigError as error:
            self._problems.take_here(error)
            for child in element.children:
                if id(child) not in self._seen:
                    self.step(child, ports)
            return NOTHING
        finally:
            self._depth -= 1

    def _step(self, element: Element, ports: Ports) -> Step:
        self._count += 1
        if self._count > MAX_STEPS:
            self._problems.take_here(
                element.wrong(f"more than {MAX_STEPS} nodes, SubTrees written out", "")
            )
            raise Enough
        kind = element.attributes.get("ID", "") if element.tag in KINDS else element.tag
        kind = OLDER.get(kind, kind) if self._older else kind
        if kind in leaves.refused():
            raise element.wrong(f"{kind} has no equivalent: {leaves.refused()[kind]}", "")
        attributes = self._attributes(element, ports, kind)
        make = NODES.get(kind)
        before = len(self._problems)
        if make is not None:
            check_ports(element, kind, attributes)
            step = make(self, element, attributes, ports)
        elif element.children:
            raise element.wrong(f"{kind} has no equivalent", nearest(kind, sorted(NODES)))
        else:
            step = leaves.step_of(element, attributes)
        if step != NOTHING and len(self._problems) == before:
            fitting.check(element, kind, attributes, step)
        return step

    def _attributes(self, element: Element, ports: Ports, kind: str = "") -> dict[str, str]:
        """The attributes with the values of the ports in them."""
        found: dict[str, str] = {}
        leaf = leaves.table().get(kind)
        for key, text in element.attributes.items():
            if key in _FOR_PEOPLE:
                continue
            if leaf is not None and key in leaf.left_out:
                self._note(element, key, kind, leaf.left_out[key])
                continue
            if key.startswith("_") and key not in AUTOREMAP:
                raise element.wrong(f"the condition {key!r} has no equivalent", "use IfThenElse")
            entry = re.fullmatch(r"\{(\w+)\}", text)
            if entry is None:
                found[key] = text
            elif entry[1] in ports:
                found[key] = ports[entry[1]]
            else:
                cure = "write the value itself, or give it as a port of the SubTree"
                raise element.wrong(f"the blackboard entry {text} has no value", cure)
        return found

    def _note(self, element: Element, port: str, kind: str, why: str) -> None:
        """Tell that a port was left out."""
        note = f"left out: line {element.line}, {port} of {kind}: {why}"
        if note not in self._notes:
            self._notes.append(note)

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
        return named({"do": self.children(element, ports)}, attributes)

    def fallback(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """One after the other until one succeeds."""
        if not element.children:
            raise element.wrong("Fallback without children", "add one")
        step = one_of([self.step(child, ports) for child in element.children])
        return named(fields(step), attributes) if fields(step) else step

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
            flat(step) if set(fields(step)) == {"do"} else step
            for step in self.children(element, ports)
        ]
        if len(branches) < 2:  # the others do nothing
            return named({"do": flat(*branches)}, attributes) if branches else NOTHING
        return named({"parallel": branches}, attributes)

    def retry(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Again, until it succeeds."""
        attempts = whole(element, attributes, "num_attempts", most=MAX_TRIES + 1)
        step = self.only(element, ports)
        return step if attempts == 1 else with_option(step, "retry", attempts - 1)

    def repeat(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Again, so many times."""
        cycles = whole(element, attributes, "num_cycles", most=MAX_ROUNDS)
        step = self.only(element, ports)
        return (
            NOTHING if step == NOTHING else named({"repeat": cycles, "do": flat(step)}, attributes)
        )

    def timeout(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Not longer than that."""
        limit_s = whole(element, attributes, "msec") / 1000.0
        return with_option(self.only(element, ports), "timeout_s", limit_s)

    def delay(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Some time later."""
        wait_s = whole(element, attributes, "delay_msec") / 1000.0
        wait = {"wait": wait_s}
        fitting.check(element, "Delay", attributes, wait)
        return {"do": [wait, *flat(self.only(element, ports))]}

    def force_success(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """Whether it succeeds or not."""
        return with_option(self.only(element, ports), "on_fail", {"any": []})

    def inverter(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """The other way round: of conditions only."""
        (child,) = element.children if len(element.children) == 1 else (element,)
        if child.tag not in _CONDITIONS:
            raise element.wrong("Inverter of an action has no equivalent", "invert a condition")
        return checked({"not": self.condition(child, ports)})

    def if_then_else(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """One or the other."""
        if len(element.children) not in (2, 3):
            raise element.wrong("IfThenElse takes two or three children", "")
        asked, *others = element.children
        branches = [flat(self.step(child, ports)) for child in others]
        found: dict[str, Any] = {"if": self.condition(asked, ports), "then": branches[0]}
        if len(branches) > 1:
            found["else"] = branches[1]
        return named(found, attributes)

    def subtree(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Another tree, with its ports."""
        name = attributes.get("ID", "")
        if name not in self._trees:
            raise element.wrong(f"there is no tree {name!r}", nearest(name, list(self._trees)))
        remapped = {
            key: self._remapped(element, key, text, ports)
            for key, text in attributes.items()
            if key not in ("ID", "name", *AUTOREMAP)
        }
        for key in remapped:
            if not reads(self._trees, name, key, older=self._older):
                why = f"nothing in the tree {name!r} reads it"
                self._note(element, key, element.tag, why)
        shared = shares_all(attributes)
        inherited = ports if shared else {}
        steps = self.tree(name, element, {**inherited, **remapped})
        return named({"do": flat(steps)}, attributes)

    def _remapped(self, element: Element, key: str, text: str, ports: Ports) -> str:
        """The value of a port of a SubTree; format 3 names the caller's entry without braces."""
        if not self._older or element.tag != "SubTree" or "{" in element.attributes[key]:
            return text
        if text not in ports:
            cure = "write it as SubTreePlus with a value, or as a port of the SubTree around it"
            raise element.wrong(f"the blackboard entry {text!r} has no value", cure)
        return ports[text]

    def recovery(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Nav2's: the first child; as often as it fails, the second and the first again."""
        tries = whole(element, {"number_of_retries": "1", **attributes}, "number_of_retries")
        if len(element.children) != 2 or tries > MAX_TRIES:
            text = f"RecoveryNode takes two children, and at most {MAX_TRIES} retries"
            raise element.wrong(text, "")
        if self._recoveries == MAX_RECOVERIES:
            text = f"RecoveryNodes in one another: at most {MAX_RECOVERIES}"
            raise element.wrong(text, "each is written out twice")
        self._recoveries += 1
        first, second = (flat(self.step(child, ports)) for child in element.children)
        self._recoveries -= 1
        if not first:
            return NOTHING
        if tries == 1:
            return named({"do": first, "on_fail": {"any": [*second, *first]}}, attributes)
        again = {"fail": "recovered, to be tried again"}
        step = {"do": first, "on_fail": {"any": [*second, again]}}
        tried = {"do": [step], "retry": tries - 1, "on_fail": {"any": first}}
        return named(tried, attributes)

    def navigate(self, element: Element, attributes: Ports, _ports: Ports) -> Step:
        """Nav2's: to one pose, or through several."""
        several = (
            element.tag == "NavigateThroughPoses" or attributes.get("ID") == "NavigateThroughPoses"
        )
        port = "goals" if several else "goal"
        poses = poses_of(element, attributes.get(port, ""))
        for height_m in dict.fromkeys(pose.pop("z_m") for pose in poses):
            if height_m:
                self._note(element, f"z {height_m:g}", port, "the robot walks on the floor")
        steps = [{"go_to": {"pose": pose}} for pose in poses]
        for step in steps:
            fitting.check(element, element.tag, attributes, step)
        if len(steps) > 1 and not several:
            raise element.wrong("NavigateToPose takes one pose", "use NavigateThroughPoses")
        return named(steps[0] if len(steps) == 1 else {"do": steps}, attributes)

    def drive(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """Nav2's: straight on or back; it fails there where distance and speed disagree."""
        speed = self._attributes(element, ports).get("speed", _DRIVE_SPEED)
        step = leaves.step_of(element, attributes)
        (slots,) = fields(step)["go_to"].values()
        forward_m = slots["forward_m"]
        speed_m_s = number_in(element, "speed", speed)
        if isinstance(forward_m, int | float) and (forward_m > 0) != (speed_m_s > 0):
            text = f"Nav2 refuses {forward_m:g} m at {speed_m_s:g} m/s: their signs differ"
            raise element.wrong(text, "both above zero (forwards), or both below (backwards)")
        return step

    def check(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """A condition among actions: it fails where it does not hold."""
        if element.tag == "Expect":
            step: Step = {"expect": self.condition(element, ports)}
            self.expected.append((element, step))
            return step
        return named(checked(self.condition(element, ports)), attributes)

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
        steps = [flat(handler) for handler in handlers]
        return with_option(first, "on_fail", dict(zip(codes, steps, strict=True)))

    def always(self, element: Element, _attributes: Ports, ports: Ports) -> Step:
        """The first child, then the second in any case."""
        if len(element.children) != 2:
            raise element.wrong("Always takes two children", "")
        first, after = (self.step(child, ports) for child in element.children)
        return with_option(first, "always", flat(after))

    def while_(self, element: Element, attributes: Ports, ports: Ports) -> Step:
        """As long as a condition holds."""
        at_most = whole(element, attributes, "at_most", most=MAX_ROUNDS)
        found = {"while": condition_in(element, attributes), "at_most": at_most}
        return named({**found, "do": flat(self.only(element, ports))}, attributes)

    def condition(self, element: Element, ports: Ports) -> Any:
        """The condition that an element states."""
        attributes = self._attributes(element, ports)
        if element.tag == "Inverter" and len(element.children) == 1:
            return {"not": self.condition(element.children[0], ports)}
        kind = attributes.get("ID", "") if element.tag in KINDS else element.tag
        if kind not in _CONDITIONS:
            raise element.wrong(f"the condition {kind!r} has no equivalent",
                                nearest(kind, sorted(_CONDITIONS)))  # fmt: skip
        check_ports(element, kind, attributes)
        return _CONDITIONS[kind](element, attributes)


Make = Callable[[Importer, Element, Ports, Ports], Step]

KINDS = ("Action", "Condition", "Control", "Decorator")
"""Tags that name their node in ID."""
_DRIVE_SPEED = "0.025"
"""Nav2's default of DriveOnHeading [m/s]."""
NODES: dict[str, Make] = {
    "Sequence": Importer.sequence,
    "SequenceWithMemory": Importer.sequence,
    "Fallback": Importer.fallback,
    "Parallel": Importer.parallel,
    "ParallelAll": Importer.parallel,
    "RetryUntilSuccessful": Importer.retry,
    "Repeat": Importer.repeat,
    "Timeout": Importer.timeout,
    "Delay": Importer.delay,
    "ForceSuccess": Importer.force_success,
    "Inverter": Importer.inverter,
    "IfThenElse": Importer.if_then_else,
    "SubTree": Importer.subtree,
    "AlwaysSuccess": Importer.nothing,
    "AlwaysFailure": Importer.failing,
    "RecoveryNode": Importer.recovery,
    "NavigateToPose": Importer.navigate,
    "NavigateThroughPoses": Importer.navigate,
    "DriveOnHeading": Importer.drive,
    "OnFail": Importer.on_fail,
    "Always": Importer.always,
    "While": Importer.while_,
    "Check": Importer.check,
    "Expect": Importer.check,
    "IsSeen": Importer.check,
    "IsHolding": Importer.check,
    "IsAt": Importer.check,
}
_CONDITIONS: dict[str, Callable[[Element, Ports], Any]] = {
    "Check": condition_in,
    "Expect": condition_in,
    "IsSeen": lambda _, ports: {"seen": ports.get("object", ""), **_some(ports, "on")},
    "IsHolding": lambda _, ports: {"holding": ports.get("object", True)},
    "IsAt": lambda _, ports: {"robot_at": ports.get("place", "")},
}


def _some(ports: Ports, *keys: str) -> dict[str, str]:
    return {key: ports[key] for key in keys if key in ports}
