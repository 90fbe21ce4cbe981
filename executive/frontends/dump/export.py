"""A run as data for other programs: MCAP for Foxglove, tables as CSV or Parquet."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from executive.frontends.console.tail import Tail
from executive.frontends.dump import foxglove
from executive.frontends.dump.looks import began_s, looks
from executive.frontends.dump.tables import Table, as_csv, as_parquet, tables
from executive.frontends.new_files import records_of, refuse_inputs, write
from executive.frontends.output import Screen, say
from executive.journal import journal, motion, sensed
from executive.journal.journal import Event
from executive.journal.motion import Moment
from executive.journal.run import Run
from executive.journal.sensed import Sensed
from robot import shots
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.shots import Shot

EXTRA: Mapping[str, tuple[str, str]] = {
    "mcap": ("foxglove", "mcap"),
    "parquet": ("pyarrow", "parquet"),
}
"""Format to the module that writes it, and the extra of this package that brings it along."""
TABLES: Mapping[str, Callable[[Table], bytes]] = {"csv": as_csv, "parquet": as_parquet}
MOST_BYTES = 150_000_000
"""Of a journal or of movements: they are held in memory as they are written."""


def export(run: Run, folder: Path, kind: str, output: Path | None) -> int:
    """Write a run for other programs, tables as files in a folder; returns the exit status.

    Args:
        run: as read from the folder.
        folder: of the run.
        kind: mcap, csv or parquet.
        output: the file, or for tables the folder; None: in the run's own.

    Raises:
        ConfigError: what writes it is not installed, the run is too long, or nothing can be
            written.
    """
    check_installed(kind)
    _check_size(folder)
    place = output or folder / (f"{folder.name}.mcap" if kind == "mcap" else kind)
    motors, scene = looks(run, folder)
    with Screen(err=True).status(f"writing {kind}"):
        if kind == "mcap":
            refuse_inputs([place], records_of(folder))
            data, left_out = foxglove.recorded(
                run, _events(folder), _moments(folder), scene=scene, motors=motors,
                began_s=began_s(folder, run), sensed=_sensed(folder), pictures=_pictures(folder),
            )  # fmt: skip
            write(place, data, run=folder)
            if left_out:
                text = f"more than {foxglove.MOST_THINGS} things: of the others"
                say(f"{text} {left_out} sightings are left out", err=True)
        else:
            for table in tables(run, _events(folder), lambda: _moments(folder), motors=motors):
                path = place / f"{table.name}.{kind}"
                refuse_inputs([path], records_of(folder))
                write(path, TABLES[kind](table), run=folder)
    if scene is None:
        lost = "there are no shapes in it" if kind == "mcap" else "joints have numbers for names"
        say(f"what the robot and its world look like is not known here: {lost}", err=True)
    say(f"Done: {place}")
    return ExitStatus.DONE


def check_installed(kind: str) -> None:
    """Refuse a format that nothing here can write.

    Raises:
        ConfigError: with the extra of this package that brings it along.
    """
    if kind in EXTRA:
        module, extra = EXTRA[kind]
        if importlib.util.find_spec(module) is None:
            cure = f"pip install 'humanoid-executive[{extra}]'"
            raise ConfigError([Problem(f"what writes {kind} is not installed", suggestion=cure)])


def _check_size(folder: Path) -> None:
    for name in (journal.FILE, motion.FILE):
        path = folder / name
        if path.is_file() and path.stat().st_size > MOST_BYTES:
            text = f"larger than {MOST_BYTES / 1e6:g} MB"
            cure = "humanoid dump --format html shows a long run"
            raise ConfigError([Problem(text, str(path), suggestion=cure)])


def _events(folder: Path) -> Iterator[Event]:
    for line in journal.lines(folder):
        event = journal.decode(line)
        if event is not None:
            yield event


def _moments(folder: Path) -> Iterator[Moment]:
    """How everything moved; nothing where that was not kept."""
    try:
        yield from (one for one in motion.read(folder) if abs(one.t_s) < journal.MOST_S)
    except OSError:
        return


def _sensed(folder: Path) -> Iterator[Sensed]:
    """What was sensed; nothing where that was not kept."""
    for line in _kept(folder / sensed.FILE, longest=sensed.MAX_LINE, most=sensed.MOST_BYTES):
        one = sensed.decode(line)
        if one is not None and abs(one.t_s) < journal.MOST_S:
            yield one


def _pictures(folder: Path) -> Iterator[Shot]:
    """What the camera saw, as far as it was kept."""
    for name in (shots.COLOUR_FILE, shots.DEPTH_FILE):
        for line in _kept(folder / name, longest=shots.MAX_LINE, most=shots.MOST_BYTES):
            shot = shots.decode(line)
            if shot is not None and abs(shot.t_s) < journal.MOST_S:
                yield shot


def _kept(path: Path, *, longest: int, most: int) -> Iterator[bytes]:
    tail = Tail(path, longest=longest, most=most)
    while lines := tail.lines():
        yield from lines
    tail.close()
