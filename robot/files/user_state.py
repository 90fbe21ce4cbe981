"""Where this software keeps what is its user's: past runs, typed lines, robots that are up."""

from __future__ import annotations

import os
from pathlib import Path


def user_state_folder() -> Path | None:
    """The folder for what is kept of this user's, made or not; None without a home.

    `$XDG_STATE_HOME/humanoid`, or `~/.local/state/humanoid` (XDG Base Directory Specification 0.8;
    a path there that is not absolute is to be ignored). A home that is not there is none: root
    could make it, and would write where nobody looks.
    """
    said = Path(os.environ.get("XDG_STATE_HOME", ""))
    if said.is_absolute():
        return said / "humanoid"
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - it never raises
    # Path.is_dir raises where a folder on the way to it is closed to us
    return home / ".local/state/humanoid" if home.is_absolute() and os.path.isdir(home) else None  # noqa: PTH112


def user_cache_folder() -> Path | None:
    """The folder for what can be made again, made or not; None without a home.

    `$XDG_CACHE_HOME/humanoid`, or `~/.cache/humanoid`, as for `user_state_folder`.
    """
    said = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if said.is_absolute():
        return said / "humanoid"
    home = Path(os.path.expanduser("~"))  # noqa: PTH111 - it never raises
    return home / ".cache/humanoid" if home.is_absolute() and os.path.isdir(home) else None  # noqa: PTH112
