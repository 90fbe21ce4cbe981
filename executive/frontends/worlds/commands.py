"""What the commands of `humanoid worlds` do."""

from __future__ import annotations

import os
from pathlib import Path

from executive.frontends.composition_root import REALITY
from executive.frontends.new_files import put, refuse_taken
from executive.frontends.output import say, write, write_json
from executive.frontends.view import PICTURES
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus

PRINTED = "-"


def list_all(*, as_json: bool = False) -> int:
    """Say what is in the shipped worlds, and which homes can be made."""
    if as_json:
        worlds = [_record(name) for name in REALITY.names()]
        write_json({"worlds": worlds, "kinds": list(REALITY.home_kinds())})
        return ExitStatus.DONE
    for name in REALITY.names():
        world_map = REALITY.world(name).map
        objects = ", ".join(sorted(f"{o.color} {o.category}" for o in world_map.objects))
        places = ", ".join(place.name for place in world_map.places)
        say(f"{name}\n  objects: {objects or 'none'}\n  places:  {places or 'none'}")
    say("Write your own: docs/worlds.md; use it with --world FILE.")
    say("What can be in it besides boxes and cylinders: humanoid worlds things.")
    kinds = ", ".join(REALITY.home_kinds())
    say(f"Or have one made: humanoid worlds new --kind KIND --seed N ({kinds}).")
    return ExitStatus.DONE


def things(*, picture: Path | None, variant: int, as_json: bool) -> int:
    """Say which kinds of things there are, and draw them.

    Raises:
        ConfigError: the picture cannot be written.
    """
    if picture is not None:
        _draw(picture, variant)
    found = REALITY.things()
    if as_json:
        write_json({"things": [one._asdict() for one in found]})
        return ExitStatus.DONE
    for family in dict.fromkeys(one.family for one in found):
        say(family)
        for one in found:
            if one.family == family:
                sizes = " x ".join(f"{100 * size:.1f}" for size in one.size_m)
                low, high = (round(1000 * mass) for mass in one.mass_kg)
                mass = f"{low} g" if low == high else f"{low} to {high} g"
                say(f"  {one.name}  {sizes} cm, {mass}; {', '.join(one.colors)}")
    say("Use one in a world file: {id: my_mug, kind: mug, on: table} (docs/worlds.md).")
    if picture is not None:
        say(f"Done: {picture}")
    return ExitStatus.DONE


def _draw(picture: Path, variant: int) -> None:
    if picture.suffix.lower() not in PICTURES:
        cure = f"call it {picture.stem or 'things'}.png"
        text = f"pictures are written as {', '.join(PICTURES)}"
        raise ConfigError([Problem(text, str(picture), suggestion=cure)])
    try:
        REALITY.save_sheet(picture, variant=variant)
    except OSError as error:
        text = f"cannot be written: {error.strerror}"
        raise ConfigError([Problem(text, str(picture), suggestion="choose another file")]) from None


def _record(name: str) -> dict[str, object]:
    """What is in a shipped world."""
    world_map = REALITY.world(name).map
    return {
        "name": name,
        "objects": [
            {"id": o.id, "name": o.full_name.removeprefix("the ")} for o in world_map.objects
        ],
        "places": [{"id": place.id, "name": place.name} for place in world_map.places],
        "people": [{"id": person.id, "name": person.name} for person in world_map.people],
    }


def new(
    kind: str,
    *,
    seed: int,
    output: Path | None,
    tasks: Path | None,
    rooms: int | None = None,
    things: int | None = None,
    lived_in: bool = False,
    real_things: bool = False,
) -> int:
    """Make a home, and print it or write it down with its tasks.

    Raises:
        ConfigError: the kind or its size is unknown, a file is there already or cannot be written.
    """
    output = None if str(output) == PRINTED else output
    if tasks is not None and output is None:
        cure = "name the world's file too: --out home.yaml --tasks home.tasks.yaml"
        raise ConfigError([Problem("the tasks need the file of their world", suggestion=cure)])
    if output is not None and tasks is not None and _whole(output) == _whole(tasks):
        cure = "--out home.yaml --tasks home.tasks.yaml"
        raise ConfigError([Problem("world and tasks are two files", str(tasks), suggestion=cure)])
    for path in (output, tasks):
        if path is not None:
            _check(path)
    home = REALITY.home(
        kind,
        seed=seed,
        file=_named(output, tasks),
        rooms=rooms,
        things=things,
        is_lived_in=lived_in,
        has_forms=real_things,
    )
    if output is None:
        write(home.world)
        return ExitStatus.DONE
    put(output, home.world)
    if tasks is not None:
        put(tasks, home.tasks)
    return ExitStatus.DONE


def _named(world: Path | None, tasks: Path | None) -> str:
    """The world's file, as seen from that of its tasks."""
    if world is None or tasks is None:
        return ""
    return os.path.relpath(_whole(world), _whole(tasks).parent)


def _whole(path: Path) -> Path:
    return Path(os.path.realpath(path.parent)) / path.name


def _check(path: Path) -> None:
    """Refuse a name that a world or its tasks cannot have, before anything is made."""
    if path.suffix not in (".yaml", ".yml"):
        cure = f"call it {path.name or 'home'}.yaml: worlds are known by that"
        raise ConfigError([Problem("this is no name of a YAML file", str(path), suggestion=cure)])
    refuse_taken(path)
