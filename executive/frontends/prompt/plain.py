"""Lines from a pipe: one after the other, each job done before the next line is read."""

from __future__ import annotations

import codecs
import os
import select
from collections.abc import Callable, Iterable, Iterator
from typing import TextIO

from executive.frontends.prompt.talk import Spoken

LOOK_S = 0.1
"""How often it is asked, while no line comes, whether any is wanted still."""
CHUNK = 65536


def work_off(shell: Spoken, lines: Iterable[str]) -> bool:
    """Do every line; ends with the last, with `quit`, when the robot is gone, or with a signal.

    Ctrl-C, SIGTERM and SIGHUP are each a wish to leave, also after the robot has come to a stand
    for it. Returns whether no line that came was left undone for that.
    """
    for line in lines:
        text = line.strip()
        if not text or text.startswith("#"):
            continue
        if shell.robot.interrupts.pressed:
            shell.out(f"Not done: “{text}”, and what follows it: a signal says to leave")
            return False
        shell.out(f"> {text}")
        shell.line(text)
        shell.robot.wait()
        if shell.gone:
            shell.out(shell.gone)
        if shell.leaving or shell.gone:
            break
    return True


def lines_until(stream: TextIO, over: Callable[[], bool]) -> Iterator[str]:
    """The lines of a stream, until it ends, or `over` says so while none comes.

    It reads past the stream's own buffer, so nothing else may have read from it.
    """
    decoder = codecs.getincrementaldecoder(stream.encoding)(stream.errors or "strict")
    open_line = ""
    while not over():
        if not select.select([stream], [], [], LOOK_S)[0]:
            continue
        data = os.read(stream.fileno(), CHUNK)
        *whole, open_line = (open_line + decoder.decode(data, final=not data)).split("\n")
        yield from whole
        if not data:
            yield open_line
            return
