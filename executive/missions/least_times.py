"""The least that parts take, whatever happens: what no limit can be shorter than.

It is a bound and no forecast: spans that are waited or held, ways by a step at the fastest walk,
one tick of whatever moves the body. What may be left out counts nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from executive.engine.executive import RATE_HZ
from executive.skills.balance import BalanceParams
from executive.skills.navigate import NavigateParams
from executive.skills.resources import needed
from executive.skills.wait import WaitParams
from executive.trees import parts as p
from executive.trees.build import ANY
from robot.model.description import RobotDescription

HELD = ("squat", "one_leg", "lean")
"""Postures that are held for their span."""
_BODY = frozenset({"legs", "left_arm", "right_arm"})


class LeastTimes:
    """How long parts take at least with one robot."""

    def __init__(self, robot: RobotDescription) -> None:
        """Nothing is known yet."""
        self._gait = robot.walking
        self._known: dict[int, float] = {}

    def too_short(
        self, part: p.Part, *, handled: bool = False
    ) -> Iterator[tuple[p.Timeout, float]]:
        """Limits that what they limit cannot keep, with what it takes at least [s].

        Those whose timeout something is done about (`on_fail`) are meant to end it.

        Args:
            part: with all that is in it.
            handled: whether something is done about a timeout of this part.
        """
        match part:
            case p.Timeout():
                least_s = self.of(part.part)
                if least_s > part.limit_s and not handled:
                    yield part, least_s
                yield from self.too_short(part.part, handled=handled)
            case p.OnFail():
                tells = any(code in ("timeout", ANY) for code, _ in part.handlers)
                yield from self.too_short(part.part, handled=handled or tells)
                for _, handler in part.handlers:
                    yield from self.too_short(handler, handled=handled)
            case _:
                for _, child in p.children(part):
                    yield from self.too_short(child, handled=handled)

    def of(self, part: p.Part) -> float:
        """What a part takes at least, if it is done well [s]."""
        known = self._known.get(id(part))
        if known is None:
            known = self._known[id(part)] = self._of(part)
        return known

    def _of(self, part: p.Part) -> float:
        match part:
            case p.Errand():
                return self._errand(part)
            case p.Series(parts=parts) | p.Each(parts=parts):
                return sum(self.of(child) for child in parts)
            case p.Parallel(parts=parts):
                return max((self.of(child) for child in parts), default=0.0)
            case p.Branch():
                look_s = self.of(part.look) if part.look is not None else 0.0
                return look_s + min(self.of(part.then), self.of(part.otherwise))
            case p.Loop(question=None):
                rounds_s = [self.of(body) for body in part.bodies[: part.at_most]]
                return sum(rounds_s) + rounds_s[-1] * (part.at_most - len(rounds_s))
            case p.Retry() | p.Timeout():
                return self.of(part.part)
            case p.OnFail():
                return min(self.of(part.part), *(self.of(handler) for _, handler in part.handlers))
            case p.Always():
                return self.of(part.part) + self.of(part.after)
            case _:
                return 0.0

    def _errand(self, errand: p.Errand) -> float:
        tick_s = 1.0 / RATE_HZ
        match errand.params:
            case WaitParams(duration_s=span_s):
                return span_s or 0.0
            case BalanceParams() as wanted if wanted.mode in HELD:
                return max(tick_s, wanted.duration_s)
            case NavigateParams(by=by) if by is not None:
                walk_s = math.hypot(by.forward_m, by.left_m) / self._gait.max_forward_m_s
                return max(tick_s, walk_s, abs(by.turn_rad) / self._gait.max_turn_rad_s)
            case params:
                return tick_s if needed(params) & _BODY else 0.0
