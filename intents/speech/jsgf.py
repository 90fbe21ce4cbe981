"""Reads grammars in the Java Speech Grammar Format (JSGF), and makes automata of them.

The part of the format that is read: rules, words, references, alternatives, ( groups ),
[ optional parts ], repetition by * and +, comments. A rule may not refer to itself.

    >>> rules = read("#JSGF V1.0; grammar g; <drink> = tea | [black] coffee; <two> = <drink>+;")
    >>> automaton(rules, "drink").accepts(["black", "coffee"])
    True

Source of the format: Sun Microsystems, Java Speech Grammar Format Specification 1.0, 1998.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Literal

import msgspec

from intents.speech.automaton import Automaton, Builder


class Node(msgspec.Struct, frozen=True):
    """A part of a rule.

    Attributes:
        kind: what it is.
        text: the word, or the name of the rule.
        parts: what it is made of, in order.
    """

    kind: Literal["word", "rule", "sequence", "choice", "repeat"]
    text: str = ""
    parts: tuple[Node, ...] = ()


Rules = Mapping[str, Node]
NOTHING = Node("sequence")
NEVER = Node("choice")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_HEADER = re.compile(r"^\s*#JSGF[^;]*;\s*grammar\s+[\w.]+\s*;")
_TOKEN = re.compile(r"<\w+>|[\w'-]+|[=|;()\[\]*+]|\S")


def read(text: str) -> Rules:
    """The rules of a grammar, by name.

    Raises:
        ValueError: it is none; the message says where.
    """
    text = _COMMENT.sub(" ", text)
    header = _HEADER.match(text)
    if header is None:
        raise ValueError("a grammar begins with '#JSGF V1.0; grammar NAME;'")
    reader = _Reader(_TOKEN.findall(text[header.end() :]))
    rules: dict[str, Node] = {}
    while reader.more:
        name, node = reader.rule()
        rules[name] = node
    return rules


def words(*spoken: str) -> Node:
    """A rule that any of the phrases fits; none fits if there is none."""
    phrases = [tuple(Node("word", word) for word in phrase.split()) for phrase in spoken]
    return Node("choice", parts=tuple(Node("sequence", parts=phrase) for phrase in phrases))


def automaton(rules: Rules, root: str) -> Automaton:
    """What fits a rule.

    Raises:
        ValueError: a rule is missing, or refers to itself.
    """
    builder = Builder()
    end = _expand(Node("rule", root), rules, builder, builder.start, ())
    return builder.automaton(end)


def _expand(node: Node, rules: Rules, builder: Builder, start: int, within: tuple[str, ...]) -> int:
    """Add what a node stands for after a state; the state that it ends in."""
    if node.kind == "word":
        end = builder.state()
        builder.arc(start, node.text, end)
        return end
    if node.kind == "rule":
        if node.text in within or node.text not in rules:
            trouble = "refers to itself" if node.text in within else "is missing"
            raise ValueError(f"rule <{node.text}> {trouble}")
        return _expand(rules[node.text], rules, builder, start, (*within, node.text))
    if node.kind == "sequence":
        for part in node.parts:
            start = _expand(part, rules, builder, start, within)
        return start
    if node.kind == "repeat":
        begin = builder.state()
        builder.arc(start, None, begin)
        end = _expand(node.parts[0], rules, builder, begin, within)
        builder.arc(end, None, begin)
        return end
    end = builder.state()
    for part in node.parts:
        first = builder.state()
        builder.arc(start, None, first)
        builder.arc(_expand(part, rules, builder, first, within), None, end)
    return end


class _Reader:
    """Recursive descent over the tokens of a grammar."""

    def __init__(self, tokens: list[str]) -> None:
        self._tokens = tokens
        self._at = 0

    @property
    def more(self) -> bool:
        return self._at < len(self._tokens)

    def _peek(self) -> str:
        return self._tokens[self._at] if self.more else ""

    def _take(self, wanted: str = "") -> str:
        token = self._peek()
        if not token or (wanted and token != wanted):
            before = " ".join(self._tokens[max(0, self._at - 4) : self._at])
            found = f"found {token!r}" if token else "it ends"
            raise ValueError(f"after “{before}” {wanted or 'something'!r} is missing, {found}")
        self._at += 1
        return token

    def rule(self) -> tuple[str, Node]:
        """One definition, to its semicolon."""
        if self._peek() == "public":
            self._take()
        name = self._take()
        self._take("=")
        node = self._choice()
        self._take(";")
        return name.strip("<>"), node

    def _choice(self) -> Node:
        parts = [self._sequence()]
        while self._peek() == "|":
            self._take()
            parts.append(self._sequence())
        return parts[0] if len(parts) == 1 else Node("choice", parts=tuple(parts))

    def _sequence(self) -> Node:
        parts: list[Node] = []
        while self._peek() not in ("|", ";", ")", "]", ""):
            parts.append(self._repeated(self._item()))
        return parts[0] if len(parts) == 1 else Node("sequence", parts=tuple(parts))

    def _repeated(self, node: Node) -> Node:
        while self._peek() in ("*", "+"):
            often = Node("repeat", parts=(node,))
            node = often if self._take() == "+" else Node("choice", parts=(NOTHING, often))
        return node

    def _item(self) -> Node:
        token = self._take()
        if token in ("(", "["):
            node = self._choice()
            self._take(")" if token == "(" else "]")
            return node if token == "(" else Node("choice", parts=(NOTHING, node))
        if token.startswith("<"):
            return Node("rule", token.strip("<>"))
        if not re.fullmatch(r"[\w'-]+", token):
            raise ValueError(f"{token!r} is not expected here")
        return Node("word", token)
