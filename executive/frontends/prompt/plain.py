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


def work_off(shell: Spoken, lines: Iterable[str], *, stops: int | None = None) -> bool:
    """Do every line; ends with the last, with `quit`, when the robot is gone, or is to stop.

    The end of the lines is nobody who leaves: what is open by then is done first.

    Where the robot asks for help, the next line may answer it. If that is about something else, or
    there is none, nobody answers, and what asked is given up.

    Ctrl-C, SIGTERM and SIGHUP are each a wish to leave, also after the robot has come to a stand
    for it. A stop that is none of the lines (on a page, in another terminal) is about all that
    follow. Returns whether no line that came was left undone for that.

    Args:
        shell: does them.
        lines: as they come.
        stops: so often the robot had been told to stop when they were begun (None: as now).
    """
    brake = shell.brake
    stops = brake.stops if stops is None else stops
    for line in lines:
        text = line.strip()
        if not text or text.startswith("#"):
            continue
        if shell.gone:
            break
        if shell.robot.interrupts.pressed:
            return _left_out(shell, text, "a signal says to leave")
        if brake.stops != stops:
            return _left_out(shell, text, "the robot was told to stop")
        shell.out(f"> {text}")
        own = brake.is_cry(text) or text.startswith("estop")
        while not own and shell.unhelped(text):
            shell.robot.wait(asked=True)
        shell.line(text)
        shell.robot.wait(asked=True)
        if own:
            stops = brake.stops
        if shell.leaving or shell.gone:
            break
    else:
        shell.robot.wait(asked=True)
        while shell.unhelped():
            shell.robot.wait(asked=True)
    if shell.gone:
        shell.out(shell.gone)
    return True


def _left_out(shell: Spoken, text: str, why: str) -> bool:
    shell.out(f"Not done: “{text}”, and what follows it: {why}")
    return False


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
