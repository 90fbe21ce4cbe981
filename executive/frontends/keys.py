"""The user's keys for language models: which host gets which, in a file of the user's own.

    # ~/.config/humanoid/keys.toml, mode 600
    ["api.example.com"]
    key_file = "~/.config/humanoid/example.key"     # mode 600, nothing but the key

    ["models.example.org:8443"]
    key_variable = "EXAMPLE_ORG_KEY"                # or an environment variable

An endpoint's file may come from anywhere, and names none: it could send any file to any host.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from robot.errors import ConfigError, Problem
from robot.files import plain_data, users_own
from robot.files.ordinary_files import read_secret

if TYPE_CHECKING:
    from intents.language_model import Key

MAX_FILE_BYTES = 64_000
MAX_KEY_BYTES = 4_096


class Source(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Where the key for a host is: in a file that holds nothing else, or in a variable."""

    key_file: str = ""
    key_variable: str = ""

    def __post_init__(self) -> None:
        """Check that it is one of them. Raises ValueError."""
        if bool(self.key_file) == bool(self.key_variable):
            raise ValueError("give either key_file or key_variable")


def path() -> Path:
    """Where the keys of this user are named."""
    return users_own.folder() / "keys.toml"


def sources(file: Path) -> dict[str, Source]:
    """The hosts that have a key, and where each is; none where there is no such file.

    Raises:
        ConfigError: the file cannot be used as it is.
    """
    try:
        data = read_secret(file, limit=MAX_FILE_BYTES)
        found = plain_data.from_toml(data.decode())
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except OSError as error:
        raise ConfigError([Problem(f"cannot be used: {error.strerror}", str(file))]) from None
    except UnicodeDecodeError:
        raise ConfigError([Problem("this is no UTF-8 text", str(file))]) from None
    except ValueError as error:
        raise ConfigError([Problem(str(error), str(file))]) from None
    listed = plain_data.fitted(found, dict[str, Source], file)
    return {host.lower(): source for host, source in listed.items()}


def key_for(host: str, *, file: Path | None = None) -> Key:
    """The key that the user keeps for a host; an empty one where there is none.

    Args:
        host: with its port, where that is an odd one.
        file: that names the keys; by default the user's.

    Raises:
        ConfigError: it is named, and cannot be read; what is read is never in the message.
    """
    from intents.language_model import Key  # httpx takes long to load

    file = file or path()
    source = sources(file).get(host)
    if source is None:
        return Key()
    if source.key_variable:
        where, secret = f"the variable {source.key_variable}", os.environ.get(source.key_variable)
    else:
        where, secret = source.key_file, _read(source.key_file, file)
    if not secret:
        raise ConfigError([Problem(f"the key for {host} is empty: {where}", str(file))])
    try:
        return Key(secret)
    except ValueError as error:
        text = f"the key for {host} is none ({where}): {error}"
        raise ConfigError([Problem(text, str(file))]) from None


def _read(name: str, file: Path) -> str:
    key = file.parent / os.path.expanduser(name)  # noqa: PTH111 - it never raises
    try:
        return read_secret(key, limit=MAX_KEY_BYTES).decode("latin-1").strip()
    except OSError as error:
        text = f"the key in {key} cannot be used: {error.strerror}"
        raise ConfigError([Problem(text, str(file))]) from None
