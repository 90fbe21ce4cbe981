"""A mission to a BehaviorTree.CPP v4 tree with a TreeNodesModel, which reads back to the same.

Parameters are filled in, sub-missions and for_each are written out. Steps become the stock nodes
that do the same; what BehaviorTree.CPP has no node for (`OnFail`, `Always`, `While`) is declared in
the model, as the leaves are.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, cast
from xml.etree import ElementTree as Tree

import msgspec

from executive.missions.btcpp import leaves
from executive.missions.btcpp.steps import JSON
from executive.missions.expanding import expanded
from robot.reality.contract import Reality

OWN: dict[str, tuple[str, tuple[str, ...]]] = {
    "OnFail": ("Control", ("codes",)),
    "Always": ("Control", ()),
    "While": ("Decorator", ("condition", "at_most")),
    "Check": ("Condition", ("condition",)),
    "Expect": ("Condition", ("condition",)),
}
"""Nodes that are no stock ones: their kind and their ports."""


def xml_of(path: Path, reality: Reality) -> str:
    """A mission file as XML.

    Raises:
        ConfigError: with everything that is wrong in the file.
    """
    return xml_of_data(expanded(path, reality))


def xml_of_data(mission: dict[str, Any]) -> str:
    """A mission's data, without parameters and calls, as XML."""
    name = str(mission["name"])
    root = Tree.Element("root", {"BTCPP_format": "4", "main_tree_to_execute": name})
    tree = Tree.SubElement(root, "BehaviorTree", {"ID": name})
    steps = [_step(step) for step in mission["steps"]]
    steps += [_asked("Expect", condition) for condition in mission.get("expect", ())]
    node = _node("Sequence", {}, steps)
    limit_s = mission.get("limits", {}).get("duration_s")
    if limit_s is not None:
        node = _node("Timeout", {"msec": str(round(1000 * limit_s))}, [node])
    if mission.get("always"):
        node = _node("Always", {}, [node, _sequence(mission["always"])])
    tree.append(node)
    root.append(_model(node))
    Tree.indent(root)
    return Tree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _node(tag: str, attributes: dict[str, str], children: list[Tree.Element]) -> Tree.Element:
    node = Tree.Element(tag, attributes)
    node.extend(children)
    return node


def _sequence(steps: list[Any]) -> Tree.Element:
    if not steps:
        return Tree.Element("AlwaysSuccess")
    return _node("Sequence", {}, [_step(step) for step in steps])


def _step(step: Any) -> Tree.Element:
    """A step with its options around it."""
    if isinstance(step, str):
        return Tree.Element(*leaves.leaf_of("sentence", step))
    node = _core(step)
    if "name" in step:
        node.set("name", str(step["name"]))
    if "retry" in step:
        node = _node("RetryUntilSuccessful", {"num_attempts": str(step["retry"] + 1)}, [node])
    if "timeout_s" in step:
        node = _node("Timeout", {"msec": str(round(1000 * step["timeout_s"]))}, [node])
    if "on_fail" in step:
        codes = ";".join(step["on_fail"])
        handlers = [_sequence(steps) for steps in step["on_fail"].values()]
        node = _node("OnFail", {"codes": codes}, [node, *handlers])
    if "always" in step:
        node = _node("Always", {}, [node, _sequence(step["always"])])
    return node


def _core(step: dict[str, Any]) -> Tree.Element:
    """A step without its options."""
    if "parallel" in step:
        branches = [
            _sequence(cast("list[Any]", branch)) if isinstance(branch, list) else _step(branch)
            for branch in step["parallel"]
        ]
        return _node("Parallel", {"success_count": "-1", "failure_count": "1"}, branches)
    if "if" in step:
        branches = [_sequence(step["then"])]
        if "else" in step:
            branches.append(_sequence(step["else"]))
        return _node("IfThenElse", {}, [_asked("Check", step["if"]), *branches])
    if "repeat" in step:
        return _node("Repeat", {"num_cycles": str(step["repeat"])}, [_sequence(step["do"])])
    if "while" in step:
        ports = {"condition": _condition(step["while"]), "at_most": str(step["at_most"])}
        return _node("While", ports, [_sequence(step["do"])])
    if "do" in step:
        return _sequence(step["do"])
    key = next(key for key in step if key not in ("name", "retry", "timeout_s"))
    name, ports = leaves.leaf_of(key, step[key])
    return Tree.Element(name, ports)


def _asked(tag: str, condition: Any) -> Tree.Element:
    return Tree.Element(tag, {"condition": _condition(condition)})


def _condition(condition: Any) -> str:
    return (
        condition if isinstance(condition, str) else JSON + msgspec.json.encode(condition).decode()
    )


def _model(tree: Tree.Element) -> Tree.Element:
    """What the tree's nodes are, for Groot2 and for BehaviorTree.CPP."""
    model = Tree.Element("TreeNodesModel")
    for tag in sorted({node.tag for node in tree.iter()}):
        leaf = leaves.table().get(tag)
        kind, ports = OWN.get(tag, ("Action", tuple(leaf.ports) if leaf else ()))
        if leaf is None and tag not in OWN:
            continue  # a stock node
        entry = Tree.SubElement(model, kind, {"ID": tag})
        for port in ports:
            Tree.SubElement(entry, "input_port", {"name": port, "type": "std::string"})
    return model
