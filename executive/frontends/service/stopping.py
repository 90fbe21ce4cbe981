"""Stopping robots that are up: all at the same time, one that does not answer keeps no other."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.client import press
from executive.frontends.service.place import Place
from robot.errors import RobotError
from robot.exit_status import ExitStatus


class Pressed(NamedTuple):
    """What a robot said to a button."""

    name: str
    status: int
    words: str


def stop_all(name: str | None, button: m.Button) -> list[Pressed]:
    """Stop a robot; without a name, every one that is up.

    Raises:
        ConfigError: there is none.
    """
    if name is not None:
        places.check_name(name)
    up = [place for place in places.places_up() if name in (None, place.name)]
    up = up or [places.find(name)]  # says what is up
    if len(up) == 1:
        return [_press(up[0], button)]
    with ThreadPoolExecutor(len(up)) as stopping:
        return list(stopping.map(_press, up, [button] * len(up)))


def _press(place: Place, button: m.Button) -> Pressed:
    words: list[str] = []

    def hear(told: m.Told) -> None:
        if isinstance(told, m.Words):
            words.append(told.text)

    try:
        status = press(place, button, hear).status
    except RobotError as error:
        return Pressed(place.name, ExitStatus.BROKEN, str(error))
    return Pressed(place.name, status, "\n".join(words))


def pressed(done: list[Pressed]) -> int:
    """Say what each said; returns the worst exit status."""
    from executive.frontends.output import say  # after the stop: it takes a while to load

    for one in done:
        head = f"{one.name}: " if len(done) > 1 else ""
        say(f"{head}{one.words}", err=one.status != ExitStatus.DONE)
    return max(one.status for one in done)
