"""`humanoid config`: every value that can be set, and where it comes from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, cast

import typer

from executive.frontends.options import AsJson, Eyes, Localisation, Model, Robot, Seed, View, World
from executive.frontends.output import say, table_screen, write_json
from executive.frontends.settings.files import Hooks, Settings, Value

KEYS = (
    "world", "robot", "seed", "vary", "eyes", "localisation", "view", "voice", "voice_model",
    "model",
)  # fmt: skip
VARIABLES = {"model": "HUMANOID_MODEL"}


def register(app: typer.Typer, settings: Settings) -> None:
    """Add the command to the command line."""

    @app.command()
    def config(
        context: typer.Context,
        *,
        world: World = "kitchen",
        robot: Robot = "juno",
        seed: Seed = 0,
        vary: Annotated[bool, typer.Option("--vary", help="As of do.")] = False,
        eyes: Eyes = "auto",
        localisation: Localisation = "auto",
        view: View = False,
        voice: Annotated[bool, typer.Option("--voice", help="As of do.")] = False,
        voice_model: Annotated[Path | None, typer.Option("--voice-model", help="As of do.")] = None,
        model: Model = None,
        as_json: AsJson = False,
    ) -> None:
        """Show every value that can be set in a file, and where each comes from.

        [bold]Examples[/bold]

          humanoid config

          humanoid config --world bench      (what that option would change)

        Options come before variables of the environment, these before humanoid.toml of this folder,
        that before ~/.config/humanoid/config.toml, that before what is built in. A world or a robot
        that is not there is named, and the exit status is not 0.
        """
        given = {
            "world": world, "robot": robot, "seed": seed, "vary": vary, "eyes": eyes,
            "localisation": localisation, "view": view, "voice": voice,
            "voice_model": voice_model, "model": model,
        }  # fmt: skip
        sources = {key: getattr(context.get_parameter_source(key), "name", "") for key in KEYS}
        _tell(settings, given, sources, as_json=as_json)
        chosen = {key for key in ("world", "robot") if sources[key] != "DEFAULT"}
        if chosen:
            from executive.frontends.composition_root import REALITY
            from executive.meaning.request import setting

            setting(REALITY, world, robot=robot)  # or it says what is wrong with them


def origin(key: str, source: str, value: Value | None) -> str:
    """Where a value comes from, for people."""
    match source:
        case "COMMANDLINE":
            return f"option --{key.replace('_', '-')}"
        case "ENVIRONMENT":
            return f"environment: {VARIABLES.get(key, '')}"
        case "DEFAULT_MAP" if value is not None:
            return value.origin
        case _:
            return "default"


def _tell(
    settings: Settings, given: dict[str, Any], sources: dict[str, str], *, as_json: bool
) -> None:
    values = settings.values
    rows = [(key, given[key], origin(key, sources[key], values.get(key))) for key in KEYS]
    devices = values.get("devices")
    rows.append(("devices", devices and devices.value, devices.origin if devices else "default"))
    for name in Hooks.__struct_fields__:
        value = values.get(f"hooks.{name}")
        rows.append(
            (f"hooks.{name}", getattr(settings.hooks, name), value.origin if value else "default")
        )
    if as_json:
        write_json(
            [{"key": key, "value": _plain(value), "origin": where} for key, value, where in rows]
        )
        return
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    for heading in ("key", "value", "from"):
        table.add_column(heading, overflow="fold")
    for key, value, where in rows:
        table.add_row(key, _shown(value), where)
    table_screen().print(table)
    say()
    for path in (settings.project, settings.user):
        if path == settings.project and settings.passed_over:
            there = f"is not read: {settings.passed_over}"
        else:
            there = "" if path.exists() else "is not there"
        say(f"  {path}  {there}".rstrip())


def _plain(value: Any) -> Any:
    return str(value) if isinstance(value, Path) else value


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):
        return " ".join(cast("tuple[str, ...]", value))
    return str(value)
