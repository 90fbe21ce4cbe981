"""`humanoid record` and `--record`: a run as MCAP while it goes on, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Generator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from select import select
from typing import BinaryIO

import robot
from executive.frontends.dump.export import check_installed
from executive.frontends.end_signals import PATIENCE_S, Ending
from executive.frontends.new_files import records_of, refuse_inputs, refuse_taken
from executive.frontends.output import Screen, say
from executive.journal import journal, past_runs
from robot.clock import WallClock
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import make_below, open_to_append

MODULE = "executive.frontends.dump.record"
NAME = "recorded"
POLL_S = 0.02
FINISH_S = 120.0
"""What a recording may take to catch up with a fast run, and to write its index."""


def record(run: str | None, output: Path | None) -> int:
    """Write a run under way to a file until it ends, one that is over whole; or until Ctrl-C.

    A second signal leaves at once: the file can then be read as far as it was written.

    Args:
        run: its folder or a part of its name; None: the newest.
        output: the file, which must not be there; None: in the run's folder.

    Raises:
        ConfigError: there is no such run, what writes it is not installed, or it cannot be written.
    """
    check_installed("mcap")
    if output is not None and str(output) == "-":
        text = "a recording cannot go to standard output: its index is written when it ends"
        raise ConfigError([Problem(text, suggestion="name a file: -o run.mcap")])
    folder = past_runs.find(run)
    path = output or _free(folder)
    refuse_inputs([path], records_of(folder))
    refuse_taken(path)
    live = journal.is_written(folder)
    with (
        Ending(patience_s=0.0) as ending,
        _opened(path) as file,
        Screen(err=True).status("recording") as shown,
    ):

        def tell(t_s: float) -> None:
            shown.update(f"recording {folder.name}: {t_s:.1f} s")

        if live:
            say(f"Recording {folder.name}; Ctrl-C ends the recording, not the run.", err=True)
        _follow(folder, file, ending, is_over=lambda: not journal.is_written(folder), tell=tell)
    if not path.stat().st_size:
        path.unlink()
        say("Nothing was recorded: it ended before anything was read that makes sense.")
        return ExitStatus.FAILED
    say(f"Done: {path}")
    return ExitStatus.DONE


@contextmanager
def recorded(folder: Path | None, *, wanted: bool, err: bool = False) -> Generator[None]:
    """Write the run in a folder to a file inside the block, and say where; or just go on.

    Args:
        folder: of the run.
        wanted: whether anybody wants it.
        err: whether standard output is for something else.

    Raises:
        ConfigError: what writes it is not installed.
    """
    if not wanted or folder is None:
        yield
        return
    check_installed("mcap")
    path = _free(folder)
    try:
        process = _started(folder, path)
    except OSError as error:
        say(f"It cannot be recorded: {error.strerror or error}", err=True)
        yield
        return
    say(f"Recording: {path}", err=err)
    try:
        yield
    finally:
        _finish(process, path)


def _free(folder: Path) -> Path:
    """A name that nothing has: a run that went on after a crash is recorded anew, as a whole."""
    names = (f"{NAME}{'' if n == 1 else f'-{n}'}.mcap" for n in count(1))
    return next(folder / name for name in names if not os.path.lexists(folder / name))


def _started(folder: Path, path: Path) -> subprocess.Popen[bytes]:
    """The process that reads the run's files and writes that one.

    Raises:
        OSError: it cannot be started.
    """
    logs = folder / "logs"
    make_below(folder, logs)
    log = open_to_append(logs / "record.log")
    try:
        return subprocess.Popen(
            [sys.executable, "-P", "-m", MODULE, str(folder), str(path), str(os.getpid())],
            stdin=subprocess.PIPE,  # its end is the end of the run, however early that comes
            stdout=log,
            stderr=log,
            process_group=0,  # Ctrl-C is for the robot
            env={**os.environ, "PYTHONPATH": str(Path(robot.__file__).parent.parent)},
        )
    finally:
        os.close(log)


def _finish(process: subprocess.Popen[bytes], path: Path) -> None:
    """Let it write what is left, and the index; who does not want to wait leaves it to it.

    A signal within `PATIENCE_S` may be the wish that ended the run, passed on by the launcher.
    """
    clock = WallClock()
    begun_s = clock.now_s()
    with Ending(clock) as ending, Screen(err=True).status(f"finishing {path.name}"):
        if process.stdin is not None:  # that tells it; from here on signals are heard
            process.stdin.close()
        while (failed := process.poll()) is None:
            waited_s = clock.now_s() - begun_s
            if waited_s > FINISH_S:
                process.kill()
            elif ending.asked and waited_s > PATIENCE_S:
                say(f"The recording is finished in the background: {path}", err=True)
                return
            clock.sleep_until(clock.now_s() + POLL_S)
    if failed:
        say(f"The recording is not whole: {path.parent / 'logs' / 'record.log'} says why", err=True)


@contextmanager
def _opened(path: Path) -> Generator[BinaryIO]:
    """A new file, which is gone again if the disk takes no more of it: nobody could read it.

    Raises:
        ConfigError: that is so, or it cannot be made.
    """
    made = False
    try:
        with path.open("xb") as file:
            made = True
            yield file
    except OSError as error:
        if made:
            path.unlink(missing_ok=True)
        text = f"cannot be written: {error.strerror}"
        cure = "make room there, or name a file with -o"
        raise ConfigError([Problem(text, str(path), suggestion=cure)]) from None


def _follow(
    folder: Path,
    file: BinaryIO,
    ending: Ending,
    *,
    is_over: Callable[[], bool],
    tell: Callable[[float], object],
) -> None:
    try:
        with ending.breaking():
            from executive.frontends.dump.recording import follow  # Foxglove's library: it is slow
    except KeyboardInterrupt:
        if not ending.asked:
            raise
        return
    follow(folder, file, ending=ending, is_over=is_over, tell=tell)


def main(folder: str, path: str, parent_pid: str) -> None:
    """Record until standard input ends, or the parent is gone: what it wrote is whole then, too."""

    def is_over() -> bool:
        return os.getppid() != int(parent_pid) or bool(select([0], [], [], 0)[0])

    os.nice(10)
    try:
        with Ending(patience_s=0.0) as ending, _opened(Path(path)) as file:
            _follow(Path(folder), file, ending, is_over=is_over, tell=lambda _: None)
    except ConfigError as error:  # the log is for people
        sys.exit(str(error))


if __name__ == "__main__":
    main(*sys.argv[1:])
