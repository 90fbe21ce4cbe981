"""XML as elements that know their line; entities, doctypes and depth are refused at once."""

from __future__ import annotations

from pathlib import Path
from xml.parsers import expat

from robot.errors import ConfigError, Problem
from robot.files.yaml_nodes import read_text
from robot.printable import is_printable, printable

MAX_DEPTH = 100
MAX_ELEMENTS = 50_000
MAX_FILES = 50
MAX_LETTERS = 8_000_000
MODEL = "TreeNodesModel"
_WORDS = {
    "syntax error": ("it does not begin with a tag", '<root BTCPP_format="4">'),
    "no element found": ("there is nothing in it", '<root BTCPP_format="4">'),
    "mismatched tag": ("a tag is closed that was not opened", "take it out"),
    "unclosed token": ("what begins here is never closed", "add the > or the quote"),
    "duplicate attribute": ("an attribute stands twice in one tag", "leave one of them out"),
    "junk after document element": ("something stands behind the end of <root>", "take it out"),
    "undefined entity": ("a name between & and ; that nobody knows", "write & as &amp;"),
    "not well-formed (invalid token)": (
        "a letter that cannot stand here",
        'values stand in closed quotes, "..."; in them < is &lt; and & is &amp;',
    ),
}
"""What expat says, and what people are told."""


class Element:
    """A tag with its attributes, its children and its line (from 1)."""

    __slots__ = ("attributes", "children", "file", "line", "tag")

    def __init__(self, tag: str, attributes: dict[str, str], file: str, line: int) -> None:
        """Begin without children."""
        self.tag = tag
        self.attributes = attributes
        self.children: list[Element] = []
        self.file = file
        self.line = line

    def wrong(self, message: str, cure: str = "") -> ConfigError:
        """The error for something wrong with this element."""
        return ConfigError([Problem(message, self.file, self.line, None, cure or None)])


class Allowance:
    """What a file and all that it includes may hold together."""

    def __init__(self) -> None:
        """Begin with all of it."""
        self._files, self._letters, self._elements = MAX_FILES, MAX_LETTERS, MAX_ELEMENTS

    def file(self, path: str, letters: int) -> None:
        """Count a file. Raises ConfigError if it is one too many."""
        self._files -= 1
        self._letters -= letters
        if self._files < 0 or self._letters < 0:
            text = f"more than {MAX_FILES} files, or {MAX_LETTERS} letters in them"
            raise ConfigError([Problem(text, path, suggestion="include fewer")])

    def element(self, element: Element) -> None:
        """Count an element. Raises ConfigError if it is one too many."""
        self._elements -= 1
        if self._elements < 0:
            text = f"more than {MAX_ELEMENTS} elements, in all files together"
            raise element.wrong(text, "keep what is called")


def read(path: Path, allowance: Allowance | None = None) -> Element:
    """The root of an XML file, which takes of an allowance; None: of one of its own.

    Raises:
        ConfigError: it is no XML, too large, too deep, or declares a document type.
    """
    return parse(read_text(path), str(path), allowance)


def parse(text: str, file: str, allowance: Allowance | None = None) -> Element:
    """The root of an XML text; raises ConfigError as `read` does."""
    allowance = allowance or Allowance()
    allowance.file(file, len(text))
    builder = _Builder(file, allowance)
    try:
        builder.parser.Parse(text, True)  # noqa: FBT003, expat's own signature
    except expat.ExpatError as error:
        raise ConfigError([builder.problem(error, text.encode())]) from None
    assert builder.root is not None
    return builder.root


class _Builder:
    """Builds elements of expat's events."""

    def __init__(self, file: str, allowance: Allowance) -> None:
        self.file = file
        self.root: Element | None = None
        self._stack: list[Element] = []
        self._allowance = allowance
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.StartDoctypeDeclHandler = self._doctype
        self.parser.CharacterDataHandler = self._words

    def problem(self, error: expat.ExpatError, data: bytes) -> Problem:
        """What keeps the text from being XML, in words for people, where it begins."""
        what = expat.errors.messages[error.code]
        begun = self._stack[-1] if self._stack else None
        words, cure = _WORDS.get(what, ("this cannot be read", "look at the quotes and brackets"))
        line, column = error.lineno, error.offset + 1
        if begun is not None and what == "mismatched tag":
            words = f"another tag is closed than <{begun.tag}> of line {begun.line}"
            cure = f"</{begun.tag}>"
        elif begun is not None and what == "no element found":
            words, cure = f"<{begun.tag}> is never closed", f"</{begun.tag}>"
            line, column = begun.line, None
        elif what.startswith("not well-formed"):
            begins = data.rfind(b"<", 0, self.parser.ErrorByteIndex)
            tag = data[begins : self.parser.ErrorByteIndex]
            if begins >= 0 and tag.count(b'"') % 2 + tag.count(b"'") % 2 == 1 and b"\n" in tag:
                words, cure = "a quote in this tag is never closed", "add the closing quote"
                line = data.count(b"\n", 0, begins) + 1
                column = begins - data.rfind(b"\n", 0, begins)
        return Problem(f"not valid XML: {words}", self.file, line, column, cure)

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self.file, self.parser.CurrentLineNumber)
        self._allowance.element(element)
        if len(self._stack) >= MAX_DEPTH:
            raise element.wrong(f"nested deeper than {MAX_DEPTH} levels", "use SubTrees")
        for text in attributes.values():
            if not is_printable(text):
                what = f"a text holds what cannot be printed: {printable(text)[:60]}"
                raise element.wrong(what, "leave it out")
        if self._stack:
            self._stack[-1].children.append(element)
        else:
            self.root = element
        self._stack.append(element)

    def _end(self, _tag: str) -> None:
        self._stack.pop()

    def _words(self, words: str) -> None:
        """What stands between tags says something in a model of nodes only."""
        if words.strip() and not any(one.tag == MODEL for one in self._stack):
            what = f"words stand between the tags: {printable(words.strip())[:60]}"
            raise self._stack[-1].wrong(what, "make a comment of them, <!-- -->, or an attribute")

    def _doctype(self, name: str, *_rest: object) -> None:
        line = self.parser.CurrentLineNumber
        text = "document types and entities are not allowed"
        raise ConfigError([Problem(text, self.file, line, None, f"take <!DOCTYPE {name} ...> out")])
