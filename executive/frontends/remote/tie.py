"""What somebody far away has set going, and whether their link holds: without it the robot stands.

All connections of one invitation are one tie: orders come by one, and beats by every one.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from executive.frontends.remote.wire import LOST_S


@dataclass(kw_only=True)
class Tie:
    """The link of one invitation. Times are of any clock that goes on [s].

    Attributes:
        name: whose it is.
        jobs: of the robot, that came of what was said.
        lines: what was said and has come neither to jobs nor to an end; of which connection.
    """

    name: str
    jobs: set[int] = field(default_factory=set)
    lines: set[tuple[object, int]] = field(default_factory=set)
    _beating: int = 0
    _last_s: float = 0.0
    _is_broken: bool = False

    @property
    def holds(self) -> bool:
        """Whether somebody beats."""
        return self._beating > 0

    def begin(self, now_s: float) -> None:
        """A connection has begun to beat."""
        self._is_broken = self._is_broken and self.holds
        self._beating += 1
        self._last_s = now_s

    def beat(self, now_s: float) -> None:
        """A beat has come."""
        self._last_s = now_s

    def end(self, *, left: bool) -> None:
        """A connection that beat has ended; `left`: on purpose."""
        self._beating -= 1
        self._is_broken |= not left

    @property
    def is_lost(self) -> bool:
        """Whether all connections have ended, and not all on purpose, in whatever order."""
        return not self.holds and self._is_broken

    def is_silent(self, now_s: float) -> bool:
        """Whether beats that should come did not for too long."""
        return self.holds and now_s - self._last_s > LOST_S

    @property
    def may_move(self) -> bool:
        """Whether the robot may be doing something that was said by it."""
        return bool(self.jobs or self.lines)

    def take(self) -> tuple[set[int], bool]:
        """The jobs, and whether there are lines; the tie is free of them from then on."""
        jobs, lines = set(self.jobs), bool(self.lines)
        self.jobs.clear()
        self.lines.clear()
        return jobs, lines
