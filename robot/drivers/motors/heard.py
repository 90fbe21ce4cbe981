"""What motors told last, as far as every family tells it: where they are, who is late."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.jumps import Jumps
from robot.drivers.motors.mounting import MountedJoints
from robot.drivers.motors.transmission import Transmission
from robot.se3 import Array


class Heard:
    """The newest feedback of all motors of a map, at their shafts; arrays of shape (n,).

    Attributes:
        q, qd, tau, temperature_c: as told, a lost reply bridged for one period.
        heard_s: when each told where it is; -inf: never.
        misses: periods in a row without a reply.
        lost: replies that did not come, of all motors.
    """

    def __init__(self, joints: MountedJoints, fastest_rad_s: Array) -> None:
        """Nothing was heard yet; `fastest_rad_s`: of each motor, shape (n,)."""
        count = len(joints.joints)
        self._motion: Array = np.zeros((3, count))
        self.q, self.qd, self.tau = self._motion
        self.temperature_c: Array = np.full(count, np.nan)
        self.heard_s: Array = np.full(count, -np.inf)
        self.misses: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self.lost: int = 0
        self._period_s = joints.period_s
        self._jumps = Jumps(fastest_rad_s)

    @property
    def jumps(self) -> npt.NDArray[np.intp]:
        """Replies in a row that were too far from the one before."""
        return self._jumps.count

    def forget_where(self) -> None:
        """Believe whatever position comes next: a motor's zero was moved."""
        self.heard_s[:] = -np.inf
        self.misses[:] = 0

    def at_joints(self, transmission: Transmission) -> tuple[Array, Array, Array]:
        """Angles, speeds and torques of the joints; arrays of their own."""
        return transmission.at_joints(self.q, self.qd, self.tau)

    def _calm(
        self, which: npt.NDArray[np.intp], q: Array, now_s: float
    ) -> npt.NDArray[np.bool_] | None:
        """Of motors that tell these positions now, which are believed (`Jumps.calm`)."""
        return self._jumps.calm(which, q - self.q[which], now_s - self.heard_s[which])

    def _bridge(self, which: npt.NDArray[np.bool_]) -> None:
        """Move those of them that were ever heard on by one period, shape (n,)."""
        which = which & np.isfinite(self.heard_s)
        self.q += np.where(which, self.qd * self._period_s, 0.0)
