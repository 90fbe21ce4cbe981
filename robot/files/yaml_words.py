"""What keeps a text from being YAML, in words for people, at the place where it begins."""

from __future__ import annotations

from typing import Any, NamedTuple

import yaml

QUOTES = "look at the indentation, the brackets and the quotes"
_CONTEXTS = {
    "quoted scalar": ("this quote is never closed", "add the closing quote"),
    "flow sequence": ("this [ is never closed, or a comma in it is missing", "close it with ]"),
    "flow mapping": ("this { is never closed, or a comma in it is missing", "close it with }"),
}
"""What begins somewhere and ends nowhere, by the words of libyaml for what it was reading."""
_PROBLEMS = {
    "mapping values are not allowed": (
        "a colon where no key can be",
        "put a text with a colon into quotes, and indent keys of one mapping alike",
    ),
    "expected '-' indicator": (
        "this line is no item of the list above it",
        "begin it with -, or indent it as the line that it belongs to",
    ),
    "did not find expected key": (
        "this line is no key of the mapping above it",
        "indent keys of one mapping alike, write key: value, and close the quotes above",
    ),
    "could not find expected ':'": ("a key without a colon", "write key: value"),
    "unknown escape character": (
        "a backslash before a letter that has no meaning after one",
        "write two backslashes, or use single quotes",
    ),
    "<document start>": ("something stands behind the end of the document", "one document a file"),
    "expected comment or line break": (
        "a text cannot stand in the line of its | or >",
        "begin it in the next line, indented",
    ),
}
"""By a piece of what libyaml says."""


class Told(NamedTuple):
    """What is wrong, the cure, and where (from 1)."""

    message: str
    cure: str
    line: int | None
    column: int | None


def told(error: yaml.MarkedYAMLError, text: str) -> Told:
    """What a parser found, as people can use it."""
    context, problem = str(error.context or ""), str(error.problem or "")
    mark: Any = error.problem_mark or error.context_mark
    begun = next((words for name, words in _CONTEXTS.items() if name in context), None)
    if begun is not None and "escape" not in problem:
        return _at(error.context_mark or mark, *begun)
    lines = text.splitlines()
    row, at = (int(mark.line), int(mark.column)) if mark else (len(lines), 0)
    here = lines[row] if row < len(lines) else ""
    if "\t" in here[: len(here) - len(here.lstrip()) + 1]:
        return _at(mark, "a tab in an indentation", "indent with spaces, not with a tab")
    words = next((words for piece, words in _PROBLEMS.items() if piece in problem), None)
    if words is not None:
        return _at(mark, *words)
    letter = here[at : at + 1]
    if letter and ("cannot start any token" in problem or "node content" in problem):
        return _at(mark, f"nothing can begin with {letter}", "put the text into quotes")
    return _at(mark, "nobody can tell what this line means", QUOTES)


def _at(mark: Any, message: str, cure: str) -> Told:
    line, column = (mark.line + 1, mark.column + 1) if mark else (None, None)
    return Told(message, cure, line, column)
