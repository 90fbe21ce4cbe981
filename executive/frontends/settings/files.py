"""The two files in which people set what they would give as options, and what each may say.

    # ~/.config/humanoid/config.toml, the user's own
    world = "flat"
    voice = true
    model = "local.toml"                  # beside this file
    devices = ["/dev/video0"]             # that robots may open

    [hooks]
    failed = ["notify-send", "humanoid", "{text}: {cause}"]

    # humanoid.toml, in the current folder
    world = "house.yaml"                  # inside that folder
    seed = 7

A folder's file may be a stranger's: it says where and with which robot, and nothing that is run, is
sent anywhere, or names a key. One that somebody else could have written is not read.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, cast
from urllib.parse import urlsplit

import msgspec
from msgspec import Meta

from executive.frontends import keys
from executive.frontends.options import MOST_SEED
from robot.errors import ConfigError, Problem
from robot.files import config, plain_data
from robot.files.ordinary_files import is_within, open_ordinary
from robot.messages import AskedEyes, AskedLocalisation

PROJECT = Path("humanoid.toml")
MAX_BYTES = 64_000
Name = Annotated[str, Meta(min_length=1, max_length=1000)]
Command = tuple[Name, ...]
MOST_WORDS = 50


class Hooks(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is run, or which address is told, on an event (`executive.frontends.hooks`)."""

    done: Name | Command | None = None
    failed: Name | Command | None = None
    question: Name | Command | None = None

    def __post_init__(self) -> None:
        """Check that each is a command or a safe address. Raises ValueError."""
        for name in self.__struct_fields__:
            hook = getattr(self, name)
            if isinstance(hook, str):
                _check_address(name, hook)
            elif hook is not None and not 0 < len(hook) <= MOST_WORDS:
                raise ValueError(f"hooks.{name}: a command has 1 to {MOST_WORDS} words")


def _check_address(name: str, address: str) -> None:
    """Refuse what is no address to send to: only https leaves this machine. Raises ValueError."""
    try:
        url = urlsplit(address)
        host, _ = url.hostname or "", url.port
    except ValueError:
        raise ValueError(f"hooks.{name}: {address!r} is no address") from None
    if url.scheme not in ("http", "https") or not host or url.username is not None:
        cure = 'a command is a list: ["notify-send", "{text}"]'
        raise ValueError(f"hooks.{name}: {address!r} is no http address; {cure}")
    if url.scheme == "http" and host not in ("localhost", "127.0.0.1", "::1"):
        raise ValueError(f"hooks.{name}: only https leaves this machine")


class Project(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the file of a folder may set."""

    world: Name | None = None
    robot: Name | None = None
    seed: Annotated[int, Meta(ge=0, le=MOST_SEED)] | None = None
    vary: bool | None = None
    eyes: AskedEyes | None = None
    localisation: AskedLocalisation | None = None


class User(Project, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What the user's own file may set."""

    view: bool | None = None
    voice: bool | None = None
    voice_model: Name | None = None
    model: Name | None = None
    devices: Annotated[tuple[Name, ...], Meta(max_length=MOST_WORDS)] | None = None
    """That drivers of robots may open (`robot.files.users_own`)."""
    hooks: Hooks = Hooks()


class Value(msgspec.Struct, frozen=True):
    """A value that was set, and where: a file, and the line in it where that can be told."""

    value: Any
    file: str
    line: int | None = None

    @property
    def origin(self) -> str:
        """Where it comes from, for people."""
        return self.file + (f", line {self.line}" if self.line else "")


class Settings:
    """The values of both files; a folder's file comes before the user's.

    Attributes:
        project: path of the folder's file.
        passed_over: why the folder's file is not read, if it is not.
    """

    def __init__(self) -> None:
        """Read nothing yet."""
        self.project = PROJECT
        self.passed_over = ""

    @property
    def user(self) -> Path:
        """Path of the user's file."""
        return keys.path().with_name("config.toml")

    @cached_property
    def values(self) -> Mapping[str, Value]:
        """What is set, by key; hooks by `hooks.NAME` as well.

        Raises:
            ConfigError: a file cannot be read as what it should be.
        """
        own = self._of(self.user, User, self._read(self.user))
        here = self._of(self.project, Project, self._read(self.project, of_anybody=True))
        return {**own, **here}

    @cached_property
    def hooks(self) -> Hooks:
        """What is to happen on events: of the user's file alone. Raises ConfigError."""
        found = self._of(self.user, User, self._read(self.user)).get("hooks")
        return found.value if found is not None else Hooks()

    def _read(self, path: Path, *, of_anybody: bool = False) -> str | None:
        """The text of a file; None where there is none to be read."""
        try:
            with open_ordinary(path) as file:
                found = os.fstat(file.fileno())
                others = found.st_mode & stat.S_IWOTH
                if found.st_uid not in (0, os.geteuid()) or others:
                    whose = "everybody may write it" if others else "it is another user's"
                    if of_anybody:
                        self.passed_over = whose
                        return None
                    raise ConfigError([Problem(whose, str(path), suggestion=f"chmod o-w {path}")])
                data = file.read(MAX_BYTES + 1)
        except (FileNotFoundError, NotADirectoryError):
            return None
        except OSError as error:
            if of_anybody:
                self.passed_over = error.strerror or str(error)
                return None
            raise ConfigError([Problem(f"cannot be read: {error.strerror}", str(path))]) from None
        if len(data) > MAX_BYTES:
            raise ConfigError([Problem(f"larger than {MAX_BYTES // 1000} kB", str(path))])
        try:
            return data.decode()
        except UnicodeDecodeError:
            raise ConfigError([Problem("this is no UTF-8 text", str(path))]) from None

    def _of(
        self, path: Path, kind: type[User] | type[Project], text: str | None
    ) -> dict[str, Value]:
        if text is None:
            return {}
        try:
            data = cast("dict[str, object]", plain_data.from_toml(text))
        except ValueError as error:
            raise ConfigError([Problem(str(error), str(path))]) from None
        refused = _what_is_the_users(data, path) if kind is Project else {}
        problems = list(refused.values())
        try:
            of_here = {key: value for key, value in data.items() if key not in refused}
            fitted = plain_data.fitted(of_here, kind, path)
        except ConfigError as error:
            raise ConfigError([*problems, *error.problems]) from None
        if problems:
            raise ConfigError(problems)
        set_here = {
            name: getattr(fitted, name)
            for name in fitted.__struct_fields__
            if getattr(fitted, name) is not None and name in data
        }
        if isinstance(hooks := set_here.get("hooks"), Hooks):
            named = {name: getattr(hooks, name) for name in hooks.__struct_fields__}
            set_here |= {f"hooks.{name}": one for name, one in named.items() if one is not None}
        return {
            name: Value(_located(name, value, path), str(path), _line_of(name, text))
            for name, value in set_here.items()
        }


def _what_is_the_users(data: dict[str, object], path: Path) -> dict[str, Problem]:
    """The keys of a folder's file that only the user's own file may set, each as what is wrong."""
    own = set(User.__struct_fields__) - set(Project.__struct_fields__)
    cure = f"set it in {keys.path().with_name('config.toml')}, which is your own"
    text = "may not be set by a folder's file"
    wrong = sorted(own & data.keys())
    return {key: Problem(f"{key} {text}", str(path), suggestion=cure) for key in wrong}


def _located(name: str, value: Any, path: Path) -> Any:
    """A file that is named, from where the naming file is; names of what is shipped stay names.

    Raises:
        ConfigError: a folder's file names one outside its folder.
    """
    names_file = name in ("model", "voice_model") or (
        name in ("world", "robot") and config.names_file(value)
    )
    if not names_file:
        return value
    found = path.parent / os.path.expanduser(value)  # noqa: PTH111 - it never raises
    if path.name == PROJECT.name and not is_within(path.parent, found):
        cure = "name one inside it, or set it in your own file"
        raise ConfigError([Problem(f"{name} is outside the folder", str(path), suggestion=cure)])
    return found if name in ("model", "voice_model") else str(found)


def _line_of(name: str, text: str) -> int | None:
    """The line that sets a key, counted from 1."""
    name = name.rpartition(".")[2]
    found = re.search(rf"^[ \t]*+\[?{re.escape(name)}[\]\s.=]", text, re.MULTILINE)
    return text.count("\n", 0, found.end()) + 1 if found else None
