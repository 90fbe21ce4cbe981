"""The names of what a network tells apart: a line each, or `names:` of a YAML file."""

from __future__ import annotations

from pathlib import Path

from robot.errors import ConfigError, Problem
from robot.files import yaml_nodes

MOST_NAMES, LONGEST_NAME = 10_000, 200
_YAML = (".yaml", ".yml")


def read_labels(path: Path) -> tuple[str, ...]:
    """The names, by their number.

    A YAML file has them under `names`, as a list or as a mapping of numbers from 0 on, as files of
    YOLO's data sets do; any other file has a name on each line.

    Raises:
        ConfigError: it cannot be read, or names nothing.
    """
    if path.suffix.lower() in _YAML:
        names = _of_yaml(path)
    else:
        text = yaml_nodes.read_text(path).rstrip()
        names = [line.strip() for line in text.split("\n")] if text else []
    if not names:
        raise _wrong(path, "there is no name in it")
    if len(names) > MOST_NAMES or max(map(len, names)) > LONGEST_NAME:
        raise _wrong(path, f"more than {MOST_NAMES} names, or one of over {LONGEST_NAME} letters")
    if "" in names:
        raise _wrong(path, f"name {names.index('')} is empty")
    return tuple(names)


def _of_yaml(path: Path) -> list[str]:
    node = yaml_nodes.read(path)
    if "names" not in node.entries:
        raise _wrong(path, "it has no names")
    names = node.entries["names"][1]
    if names.items:
        return [item.text for item in names.items]
    if set(names.entries) != {str(number) for number in range(len(names.entries))}:
        raise _wrong(path, "the names are not numbered 0, 1, 2 and so on")
    return [names.entries[str(number)][1].text for number in range(len(names.entries))]


def _wrong(path: Path, message: str) -> ConfigError:
    cure = "a name on each line, or YAML with names: [cup, bottle]"
    return ConfigError([Problem(message=message, file=str(path), suggestion=cure)])
