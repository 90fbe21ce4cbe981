"""Parameters: what they may be, what they are in this run, and how they get into a text.

The substitution is closed: `{{name}}` is replaced by the value of a parameter, and nothing is
computed. In a sentence only names that the world knows and numbers may stand, so that a value
cannot turn a sentence into another one.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import msgspec

from executive.missions.names import Names
from executive.missions.problems import Problems
from executive.missions.schema import ParameterRecord, ParameterType
from robot.files.config import nearest
from robot.files.yaml_nodes import MAX_TEXT, Node, Scalar, text_node

PLACEHOLDER = re.compile(r"\{\{ *+((?:[^{} ]++| ++(?!\}))*+) *+\}\}")
"""Two braces, and what stands within; nothing is tried twice, however many blanks there are."""
SINGLE = re.compile(r"(?<!\{)\{ *(\w+) *\}(?!\})")
"""What was meant to be a placeholder: braces mean nothing else, in no sentence and in no name."""
SPOKEN: frozenset[ParameterType] = frozenset({"object", "place", "person", "number", "integer"})
"""Types of parameters that may stand inside a sentence."""


class Bound(msgspec.Struct, frozen=True, kw_only=True):
    """A parameter with its value; of the types in the plural, a list of texts."""

    type: ParameterType
    value: Scalar | tuple[str, ...]


class Scope:
    """The parameters that a step sees."""

    def __init__(
        self, bound: Mapping[str, Bound], problems: Problems, *, wrong: Iterable[str] = ()
    ) -> None:
        """See `bound`; what is wrong goes to `problems`.

        Parameters in `wrong` are there as well, but what is wrong with them is noted already.
        """
        self.bound = dict(bound)
        self._problems = problems
        self._wrong = frozenset(wrong)

    def inside(self, name: str, value: Bound | None) -> Scope:
        """The same with one more, for a loop's body; without a value it is a wrong one."""
        if value is None:
            return Scope(self.bound, self._problems, wrong={*self._wrong, name})
        return Scope({**self.bound, name: value}, self._problems, wrong=self._wrong - {name})

    def silent(self) -> Scope:
        """The same, which notes nothing."""
        return Scope(self.bound, Problems(), wrong=self._wrong)

    def fill(self, node: Node) -> Node | None:
        """A text with its parameters filled in; a text that is only a parameter gets its type."""
        if not self._is_closed(node):
            return None
        if "{{" not in node.text:
            return node
        alone = PLACEHOLDER.fullmatch(node.text.strip())
        if alone is not None:
            found = self._find(alone[1], node)
            return None if found is None else _as_node(found, node)
        return self._inserted(node, words=False)

    def fill_words(self, node: Node) -> Node | None:
        """A sentence with its parameters filled in: names and numbers only."""
        if not self._is_closed(node):
            return None
        return self._inserted(node, words=True) if "{{" in node.text else node

    def _is_closed(self, node: Node) -> bool:
        """Whether every placeholder has its two braces; what is wrong is noted."""
        found = SINGLE.search(node.text)
        if found is None:
            return True
        name, known = found[1], [*self.bound, *self._wrong]
        cure = f"a parameter is {{{{{name}}}}}"
        if name not in known:
            cure = nearest(name, known) if known else "this mission has no parameters"
        self._problems.add(node, f"{found[0]!r} has one brace where a parameter has two", cure)
        return False

    def _inserted(self, node: Node, *, words: bool) -> Node | None:
        bad, room = False, MAX_TEXT

        def insert(match: re.Match[str]) -> str:
            nonlocal bad, room
            if room <= 0:  # a mission that calls others doubles a text with each
                return ""
            found = self._find(match[1], node)
            if found is None or not self._fits(match[1], found, node, words=words):
                bad = True
                return ""
            room -= len(spoken := _spoken(found))
            return spoken

        if "{{" in PLACEHOLDER.sub("", node.text):
            self._problems.add(node, "this {{ is not closed", "a parameter is {{name}}")
            return None
        text = PLACEHOLDER.sub(insert, node.text)
        if room <= 0 or len(text) > MAX_TEXT:
            said = f"a text of more than {MAX_TEXT} characters with its parameters"
            self._problems.add(node, said, "make it shorter")
            return None
        return None if bad else text_node(text, node)

    def _find(self, name: str, node: Node) -> Bound | None:
        found = self.bound.get(name)
        if found is None and name not in self._wrong:
            known = [*self.bound, *self._wrong]
            cure = nearest(name, known) if known else "this mission has no parameters"
            self._problems.add(node, f"there is no parameter {name!r} here", cure)
        return found

    def _fits(self, name: str, found: Bound, node: Node, *, words: bool) -> bool:
        if isinstance(found.value, tuple):
            self._problems.add(node, f"{name!r} is a list", "use it in for_each: ... in:")
            return False
        if words and found.type not in SPOKEN:
            text = f"{name!r} is a {found.type}; in a sentence only names and numbers may stand"
            self._problems.add(node, text, "use it in say: or another key")
            return False
        return True


def _spoken(found: Bound) -> str:
    value = found.value
    return f"{value:g}" if isinstance(value, float) else str(value)


def _as_node(found: Bound, like: Node) -> Node:
    value = found.value
    if isinstance(value, tuple):
        node = Node("list", like.file, like.line, like.column)
        node.items = [text_node(text, like) for text in value]
        return node
    if isinstance(value, bool):
        return text_node("true" if value else "false", like, plain=True)
    return text_node(str(value), like, plain=not isinstance(value, str))


def bind(
    name: str, parameter: ParameterRecord, node: Node, *, names: Names, problems: Problems
) -> Bound | None:
    """A value as its parameter's type wants it; None if it does not fit, which is noted.

    Args:
        name: of the parameter.
        parameter: its declaration.
        node: the value.
        names: what there is in the world.
        problems: takes what is wrong.
    """
    kind = parameter.type
    if kind in ("objects", "places"):
        return _bind_list(name, kind, node, names=names, problems=problems)
    value = node.value if node.kind == "text" else None
    fits = {
        "number": isinstance(value, int | float) and not isinstance(value, bool),
        "integer": isinstance(value, int) and not isinstance(value, bool),
        "flag": isinstance(value, bool),
    }.get(kind, value is not None)
    if not fits:
        article = "an" if kind[0] in "aeiou" else "a"
        problems.add(node, f"the parameter {name!r} should be {article} {kind}", _EXAMPLES[kind])
        return None
    if kind in ("number", "integer", "flag"):
        return Bound(type=kind, value=value)
    known = {
        "object": names.object, "place": names.place, "person": names.person
    }.get(kind, names.text)  # fmt: skip
    return Bound(type=kind, value=node.text) if known(node, problems) is not None else None


def _bind_list(
    name: str, kind: ParameterType, node: Node, *, names: Names, problems: Problems
) -> Bound | None:
    if node.kind != "list":
        problems.add(node, f"the parameter {name!r} should be a list of names", _EXAMPLES[kind])
        return None
    check = names.object if kind == "objects" else names.place
    good = [item.text for item in node.items if item.kind == "text" and check(item, problems)]
    return Bound(type=kind, value=tuple(good)) if len(good) == len(node.items) else None


_EXAMPLES: dict[str, str] = {
    "object": "for example: red cup",
    "objects": "for example: [red cup, box]",
    "place": "for example: table",
    "places": "for example: [table, counter]",
    "person": "for example: anna",
    "text": "for example: good morning",
    "number": "for example: 2.5",
    "integer": "for example: 3",
    "flag": "true or false",
}
