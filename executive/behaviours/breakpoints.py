"""Where an operator wants the robot to wait: before steps by name or path, or before the next one.

A step that is held has not begun: the body is at rest from the step before, and nothing of it
is made yet.
"""

from __future__ import annotations

from fnmatch import fnmatchcase


class Breakpoints:
    """Patterns of steps, and the steps that they hold now."""

    def __init__(self) -> None:
        """Hold nothing."""
        self._patterns: dict[str, None] = {}
        self._held: dict[object, str] = {}
        self._passed: set[object] = set()
        self._stepping = False

    @property
    def patterns(self) -> tuple[str, ...]:
        """What is waited for."""
        return tuple(self._patterns)

    @property
    def held(self) -> tuple[str, ...]:
        """The names of the steps that are held."""
        return tuple(self._held.values())

    def add(self, pattern: str) -> None:
        """Hold every step whose path is `pattern`, or whose name it matches (`*`, `?`, `[...]`)."""
        self._patterns[pattern] = None

    def remove(self, pattern: str | None = None) -> None:
        """Forget a pattern (None: all of them); what is held stays held."""
        if pattern is None:
            self._patterns.clear()
        else:
            self._patterns.pop(pattern, None)

    def go_on(self, *, one_step: bool = False) -> None:
        """Let what is held begin; with `one_step` the next one after it is held again."""
        self._passed.update(self._held)
        self._held.clear()
        self._stepping = one_step

    def holds(self, step: object, name: str, step_id: str) -> bool:
        """Whether a step that would begin now has to wait."""
        if step in self._held:
            return True
        if step in self._passed or not (self._stepping or self._fits(name, step_id)):
            return False
        self._held[step] = name
        return True

    def forget(self, step: object) -> None:
        """The step has begun, or never will; its next round is a new one."""
        self._held.pop(step, None)
        self._passed.discard(step)

    def _fits(self, name: str, step_id: str) -> bool:
        return any(pattern == step_id or fits(pattern, name) for pattern in self._patterns)


def fits(pattern: str, name: str) -> bool:
    """Whether a pattern is one of steps of that name."""
    return fnmatchcase(name.casefold(), pattern.casefold())
