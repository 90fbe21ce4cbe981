"""A BehaviorTree.CPP tree to a mission; what has no equivalent is refused by name and line.

SubTrees are written out where they are called, with the values of their ports. A blackboard entry
that no port gives a value has none here either.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from executive.missions.btcpp import uncalled
from executive.missions.btcpp.including import trees_of
from executive.missions.btcpp.nodes import Importer
from executive.missions.btcpp.steps import Step, fields, flat
from executive.missions.btcpp.xml import Allowance, Element, read
from executive.missions.problems import Enough, Problems
from robot.errors import ConfigError
from robot.files import yaml_nodes
from robot.files.config import nearest


def mission_of(path: Path) -> str:
    """The text of a mission that does what a tree says; what was left out stands above it.

    Raises:
        ConfigError: the file is wrong, or something in it has no equivalent: all of it, by line.
    """
    notes: list[str] = []
    allowance = Allowance()
    root = read(path, allowance)
    data = mission_data(root, file_name=path.stem, notes=notes, allowance=allowance)
    try:
        text = yaml_nodes.dump(data)
        yaml_nodes.parse(text, str(path))
    except ConfigError as error:
        what = error.problems[0].message
        raise root.wrong(f"the mission that it becomes cannot be read: {what}") from None
    return "".join(f"# {note}\n" for note in notes) + text


def mission_data(
    root: Element,
    *,
    file_name: str = "imported",
    notes: list[str] | None = None,
    allowance: Allowance | None = None,
) -> dict[str, Any]:
    """The same as plain data.

    Args:
        root: of the XML.
        file_name: for a tree without a name.
        notes: takes what was left out, a line each.
        allowance: what is left of it for the files that are included.
    """
    if root.tag != "root":
        raise root.wrong(f"<{root.tag}> is no BehaviorTree.CPP file", "it begins with <root>")
    version = root.attributes.get("BTCPP_format", "3")
    if version not in ("3", "4"):
        raise root.wrong(f"format {version} of BehaviorTree.CPP is not read", "3 and 4 are")
    problems = Problems()
    try:
        trees = trees_of(root, problems, allowance)
        mission = _mission(root, trees, file_name, problems, [] if notes is None else notes)
    except Enough:
        mission = {}
    except ConfigError as error:
        problems.take_here(error)
        mission = {}
    problems.raise_any()
    return mission


def _mission(
    root: Element,
    trees: dict[str, Element],
    file_name: str,
    problems: Problems,
    notes: list[str],
) -> dict[str, Any]:
    if not trees:
        raise root.wrong("there is no <BehaviorTree> in it", "add one")
    own = [name for name, tree in trees.items() if tree.file == root.file] or [*trees]
    if len(own) > 1 and "main_tree_to_execute" not in root.attributes:
        text = f"there are {len(own)} trees, and nothing says which is the main one"
        raise root.wrong(text, f'<root main_tree_to_execute="{own[0]}">')
    main = root.attributes.get("main_tree_to_execute", own[0])
    if main not in trees:
        raise root.wrong(f"there is no tree {main!r}", nearest(main, list(trees)))
    older = root.attributes.get("BTCPP_format", "3") == "3"
    importer = Importer(trees, problems, notes, older=older)
    step = importer.tree(main, root, {})
    for name in trees:
        if name not in importer.called:
            notes.append(uncalled.look_at(name, root, trees, problems, older=older))
    mission: dict[str, Any] = {"name": main or file_name}
    outside = fields(step)
    if "do" in outside and set(outside) <= {"do", "timeout_s", "always"}:
        if "timeout_s" in outside:
            mission["limits"] = {"duration_s": outside["timeout_s"]}
        if "always" in outside:
            mission["always"] = outside["always"]
        step = {"do": outside["do"]}
    mission["steps"] = steps = flat(step)
    expected = _expected(steps, importer, problems)
    if expected:
        mission["expect"] = expected
    if not steps and len(problems) == 0:
        raise root.wrong(f"the tree {main!r} does nothing", "add a leaf")
    return mission


def _expected(steps: list[Step], importer: Importer, problems: Problems) -> list[Any]:
    """What the last steps expect; they become the mission's `expect`, and stand nowhere else."""
    found: list[Step] = []
    while steps and "expect" in fields(steps[-1]):
        found.insert(0, steps.pop())
    for element, step in importer.expected:
        if not any(step is last for last in found):
            text = "Expect belongs to the end of the main tree: it is asked when all is done"
            problems.take_here(element.wrong(text, "use Check"))
    return [step["expect"] for step in found]
