"""Where what is set in files takes the place of the defaults of options.

An option that is given, and a variable of the environment, come before a file.
"""

from __future__ import annotations

from collections.abc import Iterator, MutableMapping
from typing import Any

from executive.frontends.output import say
from executive.frontends.settings.files import Settings

PLACE = frozenset({"world", "robot", "seed", "vary", "eyes", "localisation"})
TALK = PLACE | {"view", "voice", "voice_model", "model"}
APPLIES: dict[str, frozenset[str]] = {
    "do": TALK,
    "repl": TALK,
    "up": TALK,
    "config": TALK,
    "listen": PLACE - {"vary"} | {"model", "voice_model"},
    "parse": frozenset({"world", "model"}),
    "view": PLACE - {"vary", "eyes", "localisation"},
    "doctor": frozenset({"robot"}),
    "walk": frozenset({"robot"}),
}
"""Which keys of the files are defaults of which command. Exams and missions say themselves where
they are, and replays and recordings what they were made with."""


class Defaults(MutableMapping[str, Any]):
    """The defaults of every command, as typer asks for them; files are read when one is asked for.

    So a file that is wrong keeps nobody from `humanoid stop`.
    """

    def __init__(self, settings: Settings) -> None:
        """Read nothing yet."""
        self._settings = settings

    def of(self, command: str) -> dict[str, Any]:
        """The defaults of one command. Raises ConfigError."""
        keys = APPLIES.get(command, frozenset())
        if not keys:
            return {}
        values = self._settings.values
        if self._settings.passed_over:
            say(f"{self._settings.project} is not read: {self._settings.passed_over}.", err=True)
        used = {key: values[key] for key in sorted(keys & values.keys())}
        here = [
            f"{key} {one.value}"
            for key, one in used.items()
            if one.file == str(self._settings.project)
        ]
        if here and command != "config":
            say(f"{self._settings.project}: {', '.join(here)}", err=True)
        return {key: one.value for key, one in used.items()}

    def __getitem__(self, command: str) -> dict[str, Any]:
        """The defaults of a command that has some. Raises KeyError."""
        if command not in APPLIES:
            raise KeyError(command)
        return self.of(command)

    def __iter__(self) -> Iterator[str]:
        """The commands that have some."""
        return iter(APPLIES)

    def __len__(self) -> int:
        """How many."""
        return len(APPLIES)

    def __setitem__(self, key: str, value: Any) -> None:
        """Defaults are files' to set. Raises TypeError."""
        raise TypeError(f"{key} is set in a file")

    def __delitem__(self, key: str) -> None:
        """Likewise."""
        raise TypeError(f"{key} is set in a file")
