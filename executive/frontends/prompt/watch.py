"""Tells people about a value of the blackboard as it changes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec

from executive.blackboard import NOW, Blackboard, Key
from executive.journal import words

PERIOD_S = 0.5
WIDTH = 200


class Watch:
    """Follows one key until it is ended; at most two lines a second of the runtime's time."""

    def __init__(self, board: Blackboard, name: str, out: Callable[[str], None]) -> None:
        """Follow the key of that name, and say its value now."""
        self._board = board
        self._name = name
        self._out = out
        self._told_s: float | None = None
        self._watching = True
        board.watch(self._changed)

    def end(self) -> None:
        """Say no more."""
        self._watching = False

    def _changed(self, key: Key[Any], value: object) -> None:
        if not self._watching or key.name != self._name:
            return
        now_s = self._board.read(NOW)
        if self._told_s is None or now_s - self._told_s >= PERIOD_S:
            self._told_s = now_s
            said = words.told(msgspec.to_builtins(value, enc_hook=str))
            cut = said if len(said) <= WIDTH else f"{said[:WIDTH]} ..."
            self._out(f"{self._name} = {cut}")
