"""What `humanoid status`, `stop`, `say` and the like do: from their options to an exit status."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from executive.frontends.output import Screen, Waiting, say, write_json
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service import stopping, telling
from executive.frontends.service.client import (
    TAKE_OVER_S,
    Connection,
    Cut,
    leave_it,
    leave_stop,
    press,
)
from executive.frontends.service.place import Place
from executive.frontends.since_boot import process_began_s
from intents.stopping import is_stop
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import read_ordinary

DOWN_S = 40.0
"""So long a robot may take to come to a stand and end."""
LOOK_S = 0.1
MAX_LOG_BYTES = 64_000_000


def status(name: str | None, *, as_json: bool) -> int:
    """Say how a robot is; without a name, and with several up, how each is."""
    up = [places.find(name)] if name is not None else places.places_up() or [places.find(None)]
    worst = ExitStatus.DONE
    for number, place in enumerate(up):
        if number and not as_json:
            say()
        worst = max(worst, _asked(place, m.Status(), as_json=as_json, headed=True))
    return worst


def queue(name: str | None, *, as_json: bool) -> int:
    """Say what a robot is to do, in order."""
    return _asked(places.find(name), m.Queue(), as_json=as_json)


def _asked(place: Place, request: m.Request, *, as_json: bool, headed: bool = False) -> ExitStatus:
    words: list[str] = []

    def hear(told: m.Told) -> None:
        if isinstance(told, m.Words):
            words.append(told.text)

    with Connection(place) as connection:
        ended = connection.ask(request, hear)
    if as_json:
        write_json(ended.standing)
        return ExitStatus(ended.status)
    if headed and ended.standing is not None:
        one = ended.standing
        say(f"{one.name}: {one.robot} in {one.world}, {one.runtime}, {one.run} (pid {one.pid})")
    say("\n".join(words))
    return ExitStatus(ended.status)


def button(name: str | None, pressed: m.Button) -> int:
    """Press a button of a robot's."""
    return press(places.find(name), pressed, _tell).status


def brake(name: str | None, pressed: m.Button) -> int:
    """Stop a robot; without a name, every one that is up."""
    return stopping.pressed(stopping.stop_all(name, pressed))


def _tell(told: m.Told) -> None:
    if isinstance(told, m.Words):
        say(told.text)


def say_line(name: str | None, text: str, *, wait: bool, as_json: bool) -> int:
    """Say a line to a robot, as at its prompt; returns the exit status, as `humanoid do` does.

    Raises:
        RobotError: the robot does not answer.
    """
    if not text.strip():
        cure = "say a sentence, or a command of the prompt"
        raise ConfigError([Problem("nothing was said", suggestion=cure)])
    place, words, jobs = places.find(name), list[str](), list[int]()
    if len(text) > m.MAX_TEXT and is_stop(text):
        text = "stop"  # which is all that comes of it
    if len(text) > m.MAX_TEXT:
        raise ConfigError([Problem(f"that is longer than {m.MAX_TEXT} characters")])

    def hear(told: m.Told) -> None:
        if isinstance(told, m.Queued):
            jobs.extend(told.jobs)
        elif isinstance(told, m.Words):
            words.append(told.text)
            if not as_json:
                say(told.text)

    ended = _said(place, text, wait=wait, jobs=jobs, hear=hear)
    if as_json:
        write_json({"exit_status": ended, "answers": words, "jobs": jobs})
    return ended


def _said(
    place: Place, text: str, *, wait: bool, jobs: list[int], hear: Callable[[m.Told], None]
) -> int:
    request: m.Request = m.Say(text=text, wait=wait, begun_s=process_began_s())
    cried = is_stop(text)
    meanwhile = leave_stop if cried else leave_it
    until_s = time.monotonic() + TAKE_OVER_S
    while True:
        try:
            with Connection(place, meanwhile=meanwhile) as connection:
                if wait:
                    connection.send(m.Watch())
                return connection.ask(request, hear, wait_s=None).status
        except Cut:
            if cried and places.is_up(place) and time.monotonic() < until_s:
                continue  # a stop is said again, to whoever takes over
            if not (wait and jobs and places.is_up(place)):
                raise
            request = m.Await(jobs=tuple(jobs))  # another executive goes on with them


def down(name: str | None) -> int:
    """Bring a robot to a stand and end it; returns when its processes are gone."""
    place = places.find(name)
    running = places.running(place)
    with suppress(Cut), Connection(place) as connection:
        refused = connection.ask(m.Down(), _tell).status
        if refused:
            return refused
    until_s = time.monotonic() + DOWN_S
    waiting = Waiting("coming to a stand")
    with Screen(err=True).status("coming to a stand"):
        while places.is_up(place):
            waiting.look()
            if time.monotonic() > until_s:
                pid = f" (pid {running.pid})" if running else ""
                say(f"{place.name} is still up{pid}: humanoid logs says more", err=True)
                return ExitStatus.BROKEN
            time.sleep(LOOK_S)
    say(f"{place.name} is down.")
    return ExitStatus.DONE


def logs(name: str | None, *, count: int, follow: bool) -> int:
    """Print what was said to a robot and by it, the newest last.

    Raises:
        ConfigError: there is no such robot, or nothing of it.
    """
    place = places.last(name)
    path = log_of(place)
    try:
        data = read_ordinary(path, limit=MAX_LOG_BYTES)
    except OSError as error:
        cure = "humanoid up makes one"
        raise ConfigError(
            [Problem(f"no log: {error.strerror}", str(path), suggestion=cure)]
        ) from None
    lines = data.decode(errors="replace").splitlines()
    for line in lines[-count:]:
        say(line)
    if follow:
        _follow(place, path, len(data))
    return ExitStatus.DONE


def log_of(place: Place) -> Path:
    """The log of the run that is up; before there is one, the output of a detached start."""
    running = places.running(place)
    log = Path(running.run) / "logs" / telling.LOG if running else None
    return log if log is not None and log.exists() else place.folder / places.LOG


def _follow(place: Place, path: Path, read: int) -> None:
    """Print what is added, until the robot is down."""
    begun = b""
    with path.open("rb") as file:
        file.seek(read)
        while True:
            ends = not places.is_up(place)
            *lines, begun = (begun + file.read()).split(b"\n")
            for line in lines:
                say(line.decode(errors="replace"))
            if ends:
                return
            time.sleep(LOOK_S)
