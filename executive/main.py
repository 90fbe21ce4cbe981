"""The executive as a process of its own, under a launcher that starts it again when it dies.

It runs the front end that it is told to (`robot.bringup.mailbox.Front`): a task, a mission, the
prompt. It has the terminal of the process above it; both are in one group, so Ctrl-C comes here.
"""

from __future__ import annotations

import signal
import sys
import traceback
from collections.abc import Callable, Iterable
from contextlib import nullcontext
from pathlib import Path
from types import FrameType

from executive.frontends import streams
from executive.frontends.exit import before_it_moves, ended_by
from executive.frontends.launching import FrontEnd, PlainFrontEnd
from executive.frontends.output import say, tell_of_mistakes
from robot.bringup import mailbox
from robot.bringup.mailbox import FRONT_FILE, Front, Handle
from robot.bus.lifeline import tie_to_parent
from robot.clock import WallClock
from robot.errors import ProcessError, RobotError
from robot.exit_status import ExitStatus

POLL_S = 0.02
WISHED = (signal.SIGINT, signal.SIGTERM)


def front_end(name: str) -> PlainFrontEnd:
    """The front end of that name, which is loaded with all that it needs, and nothing else is."""
    match FrontEnd(name):
        case FrontEnd.DO:
            from executive.frontends import do

            return do.in_executive
        case FrontEnd.LISTEN:
            from executive.frontends.listening import obeying

            return obeying.in_executive
        case FrontEnd.MISSION:
            from executive.frontends.missions import run

            return run.in_executive
        case FrontEnd.PROMPT:
            from executive.frontends.prompt import cli

            return cli.in_executive
        case FrontEnd.RESUME:
            from executive.frontends.past_runs import resume

            return resume.in_executive
        case FrontEnd.SERVICE:
            from executive.frontends.service import main as service

            return service.in_executive


def main(
    private: str, parent_pid: str, number: str, *, load: Callable[[str], PlainFrontEnd] = front_end
) -> int:
    """Load, build, run, close; returns the exit status. A spare waits for its turn in between.

    Args:
        private: the folder shared with the process above.
        parent_pid: of that process.
        number: how many executives have died before it is this one's turn.
        load: gives the front end of a name; another one in tests.
    """
    streams.steady()
    tell_of_mistakes()
    tie_to_parent(int(parent_pid))
    signal.signal(signal.SIGTSTP, signal.SIG_IGN)  # the launcher answers it
    folder = Path(private)
    try:
        with before_it_moves() if int(number) == 0 else nullcontext():
            run, front = _turn(folder, int(number), load)
        return run(Handle(folder, deaths=front.deaths), front.options)
    except (RobotError, KeyboardInterrupt) as error:
        return ended_by(error, as_json=bool(_read(folder).options.get("as_json")))
    except Exception:  # the launcher starts another one, which goes on where this one was
        say(traceback.format_exc().rstrip(), err=True)
        return ExitStatus.CRASHED


def _turn(
    folder: Path, number: int, load: Callable[[str], PlainFrontEnd]
) -> tuple[PlainFrontEnd, Front]:
    """Load everything, then wait until as many executives have died as `number` says.

    A wish to stop is for the executive whose turn it is: the first one hears it while it loads;
    for one that takes over the launcher does, until that hears people itself (`Handle.hear`).
    """
    heard = [wish for wish in WISHED if signal.getsignal(wish) is not signal.SIG_IGN]
    if number == 0:
        _hear(heard)
    for wish in heard if number else ():
        signal.signal(wish, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, WISHED)  # the launcher held them back
    clock = WallClock()
    from executive.runs import runtimes  # now that Ctrl-C is heard: it takes a second

    run = load(_read(folder).entry)
    runtimes.live_parts()
    while (front := _read(folder)).deaths < number:
        clock.sleep_until(clock.now_s() + POLL_S)
    if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
        signal.signal(signal.SIGHUP, _hang_up)
    return run, front


def _read(folder: Path) -> Front:
    if (front := mailbox.read(folder / FRONT_FILE, Front)) is None:
        raise ProcessError(f"{folder / FRONT_FILE} does not say what is to be done")
    return front


def _hear(wishes: Iterable[signal.Signals]) -> None:
    for wish in wishes:
        signal.signal(wish, _interrupt)


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    """A wish to stop that came while nothing was there to be stopped; told of twice it is one."""
    for wish in WISHED:
        signal.signal(wish, _pass)  # one that is pending may not be ignored any more
    raise KeyboardInterrupt


def _pass(_number: int, _frame: FrameType | None) -> None:
    """What is wished is under way."""


def _hang_up(_number: int, _frame: FrameType | None) -> None:
    """A closed terminal is a wish to stop, like SIGTERM."""
    signal.raise_signal(signal.SIGTERM)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
