"""The trees of a BehaviorTree.CPP file, and of those that it includes."""

from __future__ import annotations

from pathlib import Path

from executive.missions.btcpp.xml import Allowance, Element, read
from executive.missions.problems import Problems
from robot.errors import ConfigError
from robot.files.config import nearest

PASSED_OVER = ("TreeNodesModel", "include")


def trees_of(
    root: Element, problems: Problems, allowance: Allowance | None = None
) -> dict[str, Element]:
    """All trees by name; what is wrong around them is noted.

    What is included takes of the allowance that the file itself took of; None: of a fresh one.
    A file that is included lies beside the one that includes it, or below: what a stranger's file
    names elsewhere is not read.
    """
    found: dict[str, Element] = {}
    files = {Path(root.file).resolve()}
    _collect(root, found, problems, files=files, allowance=allowance or Allowance())
    return found


def _collect(
    root: Element,
    found: dict[str, Element],
    problems: Problems,
    *,
    files: set[Path],
    allowance: Allowance,
) -> None:
    for child in root.children:
        if child.tag == "include":
            included = _included(child, problems, files, allowance)
            if included is not None:
                _collect(included, found, problems, files=files, allowance=allowance)
        elif child.tag == "BehaviorTree":
            name = child.attributes.get("ID", "")
            if name in found:
                text = f"there are two trees {name!r}: see line {found[name].line}"
                problems.take_here(child.wrong(text, "each needs an ID of its own"))
            found.setdefault(name, child)
        elif child.tag not in PASSED_OVER:
            cure = nearest(child.tag, ["BehaviorTree", *PASSED_OVER])
            problems.take_here(child.wrong(f"<{child.tag}> has no meaning below <root>", cure))


def _included(
    element: Element, problems: Problems, files: set[Path], allowance: Allowance
) -> Element | None:
    """The root of a file that is included; None if there is none, or it is there already."""
    name = element.attributes.get("path", "")
    folder = Path(element.file).parent
    real = (folder / name).resolve()
    try:
        if "ros_pkg" in element.attributes or not name:
            raise element.wrong("only a file beside this one can be included", 'path="file.xml"')
        if not real.is_relative_to(folder.resolve()):
            raise element.wrong(f"{name!r} lies outside the folder of this file", "put it there")
        if real in files:
            return None
        files.add(real)
        if not real.is_file():
            near = [path.name for path in sorted(folder.glob("*.xml"))[:200]]
            cure = nearest(name, near) if near else "check the path"
            raise element.wrong(f"the file {name!r}, included here, is not there", cure)
        return read(folder / name, allowance)
    except ConfigError as error:
        problems.take_here(error)
        return None
