"""Everything that is written to people and to programs that read along goes through here.

Names and texts may be a stranger's: those of a world, a mission, a journal, an answer of a language
model. A terminal obeys what it is sent, so whatever it would obey is written out, here and once.
What this module does not write, nothing writes (`tests/unit/executive/frontends/test_output.py`).
"""

from __future__ import annotations

import logging
import re
import sys
import threading
import traceback
import warnings
from collections.abc import Iterable
from typing import Any, TextIO

import msgspec
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment
from rich.text import Text

from executive.frontends.streams import Lasting
from robot.clock import Clock, WallClock
from robot.printable import printable, printable_data, printable_json

SILENT_S = 2.0
"""So long a command may be silent where it draws no bar."""
PIPE_WIDTH = 160
"""Of tables where nobody's terminal says how wide they may be."""

_STAMP = re.compile(r" *(?:\[[^\]]*\] +)?")
_GAP = re.compile(r"(?<=\S)  +(?=\S)")
"""A line goes on beside its indentation, its time stamp, the last column in its first half."""


def say(text: str = "", *, err: bool = False, styled: tuple[str, str] = ("", "")) -> None:
    """Print lines for people, broken between words where the terminal is too narrow for them.

    Args:
        text: the lines.
        err: whether they go to standard error.
        styled: how the text begins, and the style in which that is shown on a terminal.
    """
    stream = sys.stderr if err else sys.stdout
    if not stream.isatty():
        _put(stream, printable(text) + "\n")
        return
    screen = Screen(err=err)
    shown = Text(fitted(printable(text), screen.width))
    begin, style = styled
    shown.stylize(style, 0, len(begin))
    screen.print(shown, soft_wrap=True)


def write(text: str) -> None:
    """Write a text that somebody keeps or a program reads: it is not broken into lines."""
    _put(sys.stdout, printable(text))


def write_json(value: object) -> None:
    """Write a value as one line of JSON."""
    try:
        data = msgspec.json.encode(value)
    except UnicodeEncodeError:  # the name of a file, of bytes that are no text
        data = msgspec.json.encode(printable_data(msgspec.to_builtins(value)))
    _put(sys.stdout, printable_json(data.decode()) + "\n")


def write_data(data: bytes) -> None:
    """Write the bytes of a file whose maker has seen to it that a terminal can be shown them."""
    if isinstance(sys.stdout, Lasting):
        sys.stdout.write_data(data)
        return
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.flush()


def ask(question: str) -> str:
    """What the person at the terminal answers; raises EOFError or KeyboardInterrupt if nothing."""
    return input(f"{printable(question)} ")


def _put(stream: TextIO, text: str) -> None:
    stream.write(text)
    stream.flush()


class Screen(Console):
    """Rich's console for texts that may be a stranger's.

    Styles are given by `style=` or `rich.text.Text`, never by markup in a text: a name may have
    brackets.
    """

    def __init__(self, *, err: bool = False, quiet: bool = False, width: int | None = None) -> None:
        """A screen on standard output, or on standard error."""
        super().__init__(
            stderr=err, quiet=quiet, width=width, markup=False, highlight=False, emoji=False
        )

    def render(
        self, renderable: RenderableType, options: ConsoleOptions | None = None
    ) -> Iterable[Segment]:
        """Pieces of text in their styles, with what a terminal would obey written out."""
        for piece in super().render(renderable, options):
            yield piece if piece.control else piece._replace(text=printable(piece.text))

    def render_str(self, text: str, **options: Any) -> Text:
        """A text to be measured and drawn: as wide as it is when it is written out."""
        return super().render_str(printable(text), **options)


class Waiting:
    """Says once what is waited for, where that takes a while and no bar is drawn.

    A pipe and a log have no bar: who waits there for ten seconds would see nothing at all.
    """

    def __init__(self, text: str, *, clock: Clock | None = None) -> None:
        """Wait from now on for what the text says."""
        self._text, self._clock = text, clock or WallClock()
        self._due_s = self._clock.now_s() + SILENT_S

    def look(self) -> None:
        """Say it, if it is time to and it has not been said."""
        if self._text and self._clock.now_s() >= self._due_s:
            if not Screen(err=True).is_terminal:
                say(f"{self._text} ...", err=True)
            self._text = ""


def table_screen() -> Screen:
    """A screen for a table: as wide as the terminal, and wide where there is none."""
    screen = Screen()
    return screen if screen.is_terminal else Screen(width=PIPE_WIDTH)


def fitted(text: str, columns: int) -> str:
    """A text whose lines are broken between words, and go on below what they began beside.

    A word that is too long for a line stays whole, so that a path can still be copied.
    """
    return "\n".join(_broken(line, columns) for line in text.split("\n"))


def _broken(line: str, columns: int) -> str:
    if cell_len(line) <= columns:
        return line
    stamp = _STAMP.match(line)
    begins = [stamp.end() if stamp else 0, *(gap.end() for gap in _GAP.finditer(line))]
    begin = max((cell_len(line[:end]) for end in begins if 2 * end <= columns), default=2)
    lines = [""]
    for gap, word in re.findall(r"( *)([^ ]+)", line):
        longer = f"{lines[-1]}{gap}{word}"
        if cell_len(longer) > columns and lines[-1].strip():
            lines.append(" " * begin + word)
        else:
            lines[-1] = longer
    return "\n".join(lines)


def tell_of_mistakes() -> None:
    """Write what Python writes by itself (tracebacks, warnings, log records) through here too."""

    def tell(kind: type[BaseException], error: BaseException, trace: object) -> None:
        del kind, trace
        say("".join(traceback.format_exception(error)).rstrip(), err=True)

    def of_thread(args: threading.ExceptHookArgs) -> None:
        if args.exc_value is not None and not isinstance(args.exc_value, SystemExit):
            tell(args.exc_type, args.exc_value, args.exc_traceback)

    def warn(message: Warning | str, *_where: object, **_more: object) -> None:
        say(f"warning: {message}", err=True)

    sys.excepthook = tell
    threading.excepthook = of_thread
    warnings.showwarning = warn
    logging.lastResort = _Told(logging.WARNING)


class _Told(logging.Handler):
    """Log records as lines for people."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print one."""
        say(self.format(record), err=True)


def as_mistake(error: BaseException) -> str:
    """What is said of an error that nobody foresaw, where people go on all the same."""
    return f"That is a mistake in this software: {type(error).__name__}: {error}"
