"""What soles tell of the floor, and the floor of soles.

The floor around the feet is a plane of the state: a height and a slope, which may change a little
from a step to the next and go back to level. A sole that has come down and bears fully is looked
at: it stands on that floor, on a floor that slopes otherwise, or on something (a sill, a stone, an
edge). On a new slope only where the other foot stands on such a one as well: a single tilted sole
may stand on a stone. A sole on something tells next to nothing of the base's height; several that
are as high as one another have found another floor.
"""

from __future__ import annotations

import math

import numpy as np

from robot.fusion.state_estimator.errors import ErrorState
from robot.fusion.state_estimator.ground import Ground, shares
from robot.fusion.state_estimator.parameters import Parameters
from robot.se3 import Array

MOST_LOWERED_M = 0.001
"""In one look: the body is moved to the new heights a tick late, and more would be felt."""
AGREE = 3
"""So many soles one after the other that stand alike elsewhere have found another floor."""
ALIKE = 0.3
"""Of two tilts: their product along one another over the larger one squared."""


class OnFloor(ErrorState):
    """The part of the filter that knows the floor.

    Attributes:
        floor: its height [m] under the foot that last stood on it, and its rise towards x and y of
            N [m/m], shape (3,).
        standing: whether each foot is held to stand still.
    """

    def __init__(self, parameters: Parameters) -> None:
        """On a level floor, as surely as `parameters` say."""
        super().__init__(parameters)
        self.standing = [False, False]
        self._since_s = [0.0, 0.0]
        self._floor_at = [0.0, 0.0]
        self._settled = [False, False]
        self._begun = [False, False]
        self._on_floor = [1.0, 1.0]
        self._odd: list[tuple[int, Array]] = []

    def _begin_floor(self) -> None:
        """A level floor at height zero under the base."""
        self._diagonal[28:] = self.parameters.level_rad**2
        self.floor[:] = 0.0
        self._floor_at[:] = self.p[:2].tolist()
        self._settled, self._begun, self._odd = [False, False], [False, False], []

    @property
    def ground(self) -> Ground:
        """What is known of the ground under and around the feet."""
        height, along, across = self.floor.tolist()
        x, y = self._floor_at
        left, right = self.feet[:, 2].tolist()
        return Ground(x, y, height, along, across, (left, right))

    def _settle(self, side: int, load: float) -> None:
        """A sole that has come down and bears fully tells of the floor that it came to."""
        if self._settled[side] or load < 1.0 or self._since_s[side] < self.parameters.landing_s:
            return
        self._settled[side] = True
        begins = not self._begun[side]
        self._wander(side)
        self._floor(0, side, math.inf)
        odd = self._z[:3].copy()
        if self._odd and self._odd[-1][0] == side:
            self._odd.pop()
        alike = self._slopes_alike(side, odd)
        on, sloping, *_ = self._judge(alike=alike)
        self._odd = [] if begins or on > 0.5 else [*self._odd[1 - AGREE :], (side, odd)]
        known = begins or on > 0.5
        if alike and not known and sloping > 0.5:
            self._diagonal[28:30] += self.parameters.bend_rad**2
            known = True
        elif len(self._odd) == AGREE and self._agree():
            self._diagonal[27] += odd[2] ** 2
            known = True
        self._on_floor[side] = 1.0 if known else 0.0
        self._update(self._floor(0, side, math.inf))
        if known:
            self._odd = []
            self._carry(side)

    def _slopes_alike(self, side: int, odd: Array) -> bool:
        """Whether the other foot stands, or stood before it was lifted, on such a slope, too."""
        if not self._begun[1 - side]:
            return False
        x, y = (self.turns[1 - side][:2, 2] + self.floor[1:]).tolist()
        tilt_x, tilt_y, _ = odd.tolist()
        other, own = x * x + y * y, tilt_x * tilt_x + tilt_y * tilt_y
        plain = min(other, own) > self.parameters.plain_rad**2
        return plain and x * tilt_x + y * tilt_y > ALIKE * max(other, own)

    def _agree(self) -> bool:
        """Whether the soles that came down last are as high as one another."""
        last = self._odd[-1][1]
        return all(abs(float(one[2] - last[2])) < self.parameters.new_m for _, one in self._odd)

    def _judge(self, *, alike: bool) -> list[float]:
        """How likely a sole is on the floor as it is known, on a new slope of it, or on what else.

        After its rows were written first.
        """
        k, H = self.parameters, self._H[:3]
        seen = H.dot(self.covariance).dot(H.T)
        on = seen + np.diag((k.flat_rad**2, k.flat_rad**2, k.height_m**2))
        bent = on + k.bend_rad**2 * H[:, 28:30].dot(H[:, 28:30].T)
        odd = seen + np.diag((k.odd_rad**2, k.odd_rad**2, k.odd_m**2))
        raised = seen + np.diag((k.flat_rad**2, k.flat_rad**2, k.odd_m**2))
        bend = k.bend_share if alike else 0.0
        before = [1.0 - bend - 2.0 * k.odd_share, bend + 1e-9, k.odd_share, k.odd_share]
        return shares(self._z[:3], [on, bent, raised, odd], before)

    def _wander(self, side: int) -> None:
        """How the floor goes on from a foot to the next is not quite known."""
        k, covariance, diagonal = self.parameters, self.covariance, self._diagonal
        if not self._begun[side]:  # where it begins it is one floor
            self._begun[side] = True
            return
        self.floor[1:] *= k.slope_kept
        covariance[28:] *= k.slope_kept
        covariance[:, 28:] *= k.slope_kept
        diagonal[27] += k.rough_m**2
        diagonal[28:] += k.slope_rad**2

    def _carry(self, side: int) -> None:
        """Go on along the floor to a foot that stands on it."""
        covariance = self.covariance
        x, y, _ = self.feet[side].tolist()
        dx, dy = x - self._floor_at[0], y - self._floor_at[1]
        self._floor_at[:] = x, y
        self.floor[0] += dx * float(self.floor[1]) + dy * float(self.floor[2])
        covariance[27] += dx * covariance[28] + dy * covariance[29]
        covariance[:, 27] += dx * covariance[:, 28] + dy * covariance[:, 29]

    def _lower(self) -> None:
        """Heights are counted from the floor that it stands on: a little at a time."""
        off_m = max(-MOST_LOWERED_M, min(MOST_LOWERED_M, float(self.floor[0])))
        for point in (self.p, *self.feet):
            point[2] -= off_m
        self.floor[0] -= off_m

    def _floor(self, row: int, side: int, since_s: float) -> int:
        """What the floor tells of a sole: as high and as sloping; returns the next free row.

        `since_s`: for how long it has not been asked.
        """
        k, H, z = self.parameters, self._H, self._z
        own = slice(row, row + 3)
        H[own] = 0.0
        turn, foot = 15 + 3 * side, 9 + 3 * side
        floor_m, along, across = self.floor.tolist()
        ux, uy, uz = self.turns[side][:, 2].tolist()
        # Turned about the vertical it is as level: no row of this may tell of a heading.
        H[row, turn + 1], H[row + 1, turn] = -uz, uz
        H[row, 28] = H[row + 1, 29] = -1.0
        tilt_x, tilt_y = ux + along, uy + across
        z[row], z[row + 1] = tilt_x, tilt_y
        x, y, height = self.feet[side].tolist()
        dx, dy = x - self._floor_at[0], y - self._floor_at[1]
        H[row + 2, 0], H[row + 2, 1], H[row + 2, foot + 2] = y, -x, 1.0
        H[row + 2, 27], H[row + 2, 28], H[row + 2, 29] = -1.0, -dx, -dy
        height -= floor_m + along * dx + across * dy
        z[row + 2] = -height
        repeats = max(1.0, 2.0 * k.flat_time_s / since_s)
        like = self._on_floor[side]
        for i, (inner, outer) in enumerate(
            ((k.flat_rad, k.odd_rad), (k.flat_rad, k.odd_rad), (k.height_m, k.odd_m))
        ):
            self._noise[row + i] = repeats / (like / inner**2 + (1.0 - like) / outer**2)
        return row + 3
