"""Folders that other users could exchange between a look at them and what is done in them."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from robot.errors import ConfigError, Problem


def check_way(folder: Path, *, cure: str) -> None:
    """Refuse a folder that others could exchange while something is done in it.

    Who owns a folder on its way, or may write into one that is not sticky, can put another one, or
    a link to one, in the place of what lies in it. Members of a folder's group are trusted, as a
    user's own group often has but one; so is who owns the root folder, root or who stands for it.

    Args:
        folder: which one; what is not there yet is passed over.
        cure: what to do instead, for people.

    Raises:
        ConfigError: if others could.
    """
    trusted = (0, os.geteuid(), Path("/").stat().st_uid)
    try:
        ways = (folder.absolute(), Path(os.path.realpath(folder)))
    except FileNotFoundError:  # the current folder is gone: nothing can be made in it
        return
    for place in dict.fromkeys(place for way in ways for place in (way, *way.parents)):
        try:
            found = (place.lstat(), place.stat())
        except OSError:  # it is not there, and may not be made
            continue
        if any(one.st_uid not in trusted for one in found):
            problem = f"{place} belongs to another user, who could exchange what is written there"
            raise ConfigError([Problem(problem, suggestion=cure)])
        if found[1].st_mode & stat.S_IWOTH and not found[1].st_mode & stat.S_ISVTX:
            problem = f"{place} can be changed by every user, and what is written there exchanged"
            raise ConfigError([Problem(problem, suggestion=f"{cure}, or chmod o-w {place}")])
