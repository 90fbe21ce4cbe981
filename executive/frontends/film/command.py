"""What `humanoid film` does, from its options to an exit status."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import msgspec
import numpy as np

from executive.frontends.film import writing
from executive.frontends.film.pictures import Composer, Frame, panel_px
from executive.frontends.new_files import records_of, refuse_inputs
from executive.frontends.output import Screen, say
from executive.frontends.recorded_place import UNSAID, place_of
from executive.journal import motion, past_runs, reader
from executive.journal.motion import Moment
from executive.journal.run import Run
from executive.runs.again.recording import discreet
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.reality.studio import Standing, Studio

HELD_S = 0.35
"""Further apart, two moments are a rest and not a motion."""
WIDTH_PX, WIDTH_BY_RAYS_PX = 800, 480
"""A picture by rays takes three times as long as one by EGL on a processor: 0.4 s at 560 x 450."""
LINGER_S = 1.5
"""How long the last picture stays, in seconds of the film."""
ASPECT = 0.5625
FOLLOW_S = 0.8
"""The camera's time constant as it follows the robot, in seconds of the run (and not pictures: the
robot stays in the picture at any --speed): a step's sway to the side, of 0.6 s, hardly shows."""
MOST_THINGS = 10_000
"""Of one kind whose places are kept: more than any world has."""


class Asked(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid film`."""

    run: str | None = None
    output: Path | None = None
    gif: bool = False
    speed: float = 2.0
    begin_s: float | None = None
    end_s: float | None = None
    width: int | None = None


def film(asked: Asked) -> int:
    """Make the film; returns the exit status.

    Raises:
        ConfigError: there is no such run, its movements were not kept, or nothing can be written.
    """
    folder = past_runs.find(asked.run)
    path = asked.output or folder / f"film{'.gif' if asked.gif else writing.best()}"
    if asked.gif and path.suffix.casefold() != ".gif":
        text = f"--gif makes a .gif, and {path.name} is none"
        raise ConfigError([Problem(text, suggestion="leave out --gif, or call it so")])
    kind = writing.kind_of(path)
    refuse_inputs([path], records_of(folder))
    run = reader.read(folder)
    begin_s, end_s = _span(asked, folder)
    count = math.ceil((end_s - begin_s) / asked.speed * kind.rate_hz) + 1
    if count > kind.most_frames:
        cure = f"--speed {math.ceil(asked.speed * count / kind.most_frames)}, or --from and --to"
        text = f"{count} pictures are too many for a {kind.suffix}"
        raise ConfigError([Problem(text, str(path), suggestion=cure)])
    times = [begin_s + k * asked.speed / kind.rate_hz for k in range(count)]
    with ExitStack() as opened:
        studio, width, height = _opened(run, folder, asked.width, opened)
        composer = Composer(run, width=width, height=height)
        frames = _frames(motion.read(folder), times, studio, composer)
        linger = round(LINGER_S * kind.rate_hz)
        with Screen(err=True).status("making the film") as status:

            def shown() -> Iterator[Frame]:
                last: Frame | None = None
                for number, frame in enumerate(frames):
                    status.update(f"making the film: {100 * number // count} %")
                    last = frame
                    yield frame
                if last is not None:
                    yield from [last] * linger

            writing.write(path, kind, shown(), width=width, height=height)
    size = path.stat().st_size / 1e6
    long_s = count / kind.rate_hz
    say(f"Done: {path}  ({long_s:.0f} s, {asked.speed:g} times as fast, {size:.1f} MB)")
    return ExitStatus.DONE


def _opened(
    run: Run, folder: Path, wanted: int | None, opened: ExitStack
) -> tuple[Studio, int, int]:
    """The studio, and the width and height of the film [px], which is smaller without EGL."""

    def of(width: int) -> tuple[Studio, int, int]:
        width -= width % 2
        height = 2 * round(ASPECT * width / 2)
        made = _studio(run, folder, width - panel_px(width), height)
        return opened.enter_context(made), width, height

    found = of(wanted or WIDTH_PX)
    if found[0].by != "rays":
        return found
    smaller = ""
    if wanted is None:
        opened.close()
        found = of(WIDTH_BY_RAYS_PX)
        smaller = f", and {WIDTH_BY_RAYS_PX} pixels wide"
    cure = "`humanoid doctor` says what to install"
    say(f"EGL is not here ({cure}): drawn by rays, without shadows{smaller}", err=True)
    return found


def _span(asked: Asked, folder: Path) -> tuple[float, float]:
    """From when to when the film goes; moments are read one by one, for they may be many."""
    first_s = last_s = math.nan
    try:
        for moment in motion.read(folder):
            first_s = moment.t_s if math.isnan(first_s) else first_s
            last_s = moment.t_s
    except OSError as error:
        cure = "runs that are made from now on keep it"
        text = f"it was not kept how anything moved: {error.strerror}"
        raise ConfigError([Problem(text, str(folder / motion.FILE), suggestion=cure)]) from None
    if math.isnan(first_s):
        raise ConfigError([Problem("nothing has moved in this run", str(folder))])
    begin_s = first_s if asked.begin_s is None else asked.begin_s
    end_s = last_s if asked.end_s is None else asked.end_s
    if not first_s <= begin_s <= end_s <= last_s:
        text = f"the run goes from {first_s:.2f} to {last_s:.2f} s"
        raise ConfigError([Problem(text, suggestion="choose --from and --to in between")])
    return begin_s, end_s


def _studio(run: Run, folder: Path, width: int, height: int) -> Studio:
    with discreet(folder):
        place = place_of(run.about)
        if place is None:
            raise ConfigError(UNSAID)
        return place.world.studio(place.robot, width=width, height=height)


def _frames(
    moments: Iterator[Moment], times: list[float], studio: Studio, composer: Composer
) -> Iterator[Frame]:
    """The pictures, in order; the camera follows the robot without its sway."""
    at: tuple[float, float] | None = None
    before_s = times[0]
    for t_s, standing in zip(times, standings(moments, times), strict=True):
        x, y, *_ = standing.base
        part = 1.0 - math.exp((before_s - t_s) / FOLLOW_S)
        at = (x, y) if at is None else (at[0] + part * (x - at[0]), at[1] + part * (y - at[1]))
        before_s = t_s
        yield composer.compose(studio.shoot(standing, at_m=at), t_s)


def standings(moments: Iterator[Moment], times: list[float]) -> Iterator[Standing]:
    """How everything stood at some growing times, from the moments, one after the other."""
    objects: dict[str, motion.Flat | None] = {}
    people: dict[str, motion.Flat | None] = {}
    now = next(moments)
    after: Moment | None = now
    for t_s in times:
        while after is not None and (after is now or after.t_s <= t_s):
            now = after
            for kept, new in ((objects, now.objects), (people, now.people)):
                if len(kept) < MOST_THINGS:
                    kept.update(new)
            after = next(moments, None)
        base, q = _between(now, after or now, t_s)
        yield Standing(base=base, q=q, objects=dict(objects), people=dict(people))


def _between(a: Moment, b: Moment, t_s: float) -> tuple[motion.Flat, tuple[float, ...]]:
    gap_s = b.t_s - a.t_s
    if not 0.0 < gap_s <= HELD_S or len(a.q) != len(b.q):
        return a.base, a.q
    part = min(1.0, max(0.0, (t_s - a.t_s) / gap_s))
    first, second = np.array(a.base), np.array(b.base)
    if first[3:] @ second[3:] < 0.0:
        second[3:] *= -1.0
    base = (1.0 - part) * first + part * second
    base[3:] /= np.linalg.norm(base[3:]) or 1.0
    q = (1.0 - part) * np.array(a.q) + part * np.array(b.q)
    x, y, z, w, i, j, l = (float(one) for one in base)  # noqa: E741
    return (x, y, z, w, i, j, l), tuple(float(one) for one in q)
