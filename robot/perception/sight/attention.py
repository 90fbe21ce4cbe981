"""When to look: a picture costs as much as all else that a robot does in the same time.

Eyes that have come to rest somewhere new look several times in a row, what goes on before them then
is looked at now and then, and in passing there are glances.
"""

from __future__ import annotations

import math
from collections import deque

from robot.se3 import SE3

STILL_M, STILL_RAD, STILL_S = 0.008, math.radians(0.8), 0.12
"""A camera that moved less in that time is at rest."""
NEW_M, NEW_RAD = 0.06, math.radians(3.0)
"""A view from so far from where the last looks were is a new one."""
LOOKS, AGAIN_S = 4, 0.2
"""At a new view, and how far apart."""
WATCH_S, PASSING_S = 0.5, 0.8
"""Between looks at a view that is known, and while the camera moves."""


class Attention:
    """Decides for each moment whether it is worth a picture."""

    def __init__(self) -> None:
        """Look at once."""
        self._before: deque[tuple[float, SE3]] = deque(maxlen=16)
        self._looked_from: SE3 | None = None
        self._looked_s = -math.inf
        self._count = 0

    def wants(self, now_s: float, X_WC: SE3) -> bool:
        """Whether to look now, with the camera there; it is taken for done where the answer is yes.

        Call it again and again, also while it says no.
        """
        self._before.append((now_s, X_WC))
        since_s = now_s - self._looked_s
        if not self._is_still(now_s, X_WC):
            return since_s >= PASSING_S - 1e-6 and self._look(now_s, X_WC, is_new=True)
        is_new = self._looked_from is None or apart(X_WC, self._looked_from) > 1.0
        if is_new or self._count < LOOKS:
            return since_s >= AGAIN_S - 1e-6 and self._look(now_s, X_WC, is_new=is_new)
        return since_s >= WATCH_S - 1e-6 and self._look(now_s, X_WC, is_new=False)

    def _is_still(self, now_s: float, X_WC: SE3) -> bool:
        recent = [X for time_s, X in self._before if now_s - time_s <= STILL_S + 1e-6]
        return len(recent) > 1 and all(
            math.dist(X.p, X_WC.p) < STILL_M and _turn_rad(X, X_WC) < STILL_RAD for X in recent
        )

    def _look(self, now_s: float, X_WC: SE3, *, is_new: bool) -> bool:
        self._looked_s, self._looked_from = now_s, X_WC
        self._count = 1 if is_new else self._count + 1
        return True


def apart(X_WA: SE3, X_WB: SE3) -> float:
    """How far two views are apart: above 1 it is another one."""
    return max(math.dist(X_WA.p, X_WB.p) / NEW_M, _turn_rad(X_WA, X_WB) / NEW_RAD)


def _turn_rad(X_WA: SE3, X_WB: SE3) -> float:
    dot = abs(sum(a * b for a, b in zip(X_WA.quat_wxyz, X_WB.quat_wxyz, strict=True)))
    return 2.0 * math.acos(min(1.0, dot))
