"""Where the odometry frame N lies in the world W, from absolute fixes of the base.

Both frames have z up, so X_WN is x, y, z and yaw. A fix that is far from what odometry says is an
outlier; several in a row that agree with each other are a jump: the robot was somewhere else than
believed, and says so.
"""

from __future__ import annotations

import math

from robot.fusion.history import BodyHistory
from robot.messages import PoseFix, Source
from robot.se3 import SE3, rotate, wrap_angle

SMOOTHING_S = 0.4
GATE_M = 0.12
GATE_RAD = 0.15
DRIFT_M_S = 0.05
DRIFT_RAD_S = 0.05
FIXES_TO_JUMP = 5


class Localiser:
    """Keeps X_WN.

    Attributes:
        fixed_s: stamp of the last fix believed, -inf before the first.
        jumps: how often the estimate had to be thrown over.
        rejected: fixes not believed, in all.
        source: where the fixes come from.
        covariance: of the last fix believed, as it says.
    """

    def __init__(self, history: BodyHistory) -> None:
        self._pose = SE3()
        self.fixed_s = -math.inf
        self.jumps = 0
        self.rejected = 0
        self.source: Source = "estimate"
        self.covariance: tuple[float, ...] = ()
        self._history = history
        self._restarts = history.restarts
        self._suspect: SE3 | None = None
        self._suspects = 0
        self._thrown_over = False

    @property
    def X_WN(self) -> SE3:
        """The estimate; identity before the first fix."""
        return self._pose

    def add(self, fix: PoseFix) -> bool:
        """Take a fix; says whether it was believed.

        A fix without a body state near its stamp cannot be compared and is not believed.
        """
        X_NB = self._history.base_at(fix.stamp_s)
        if X_NB is None or not _finite(fix.X_WB):
            self.rejected += 1
            return False
        X_WN = _between(fix.X_WB, X_NB)
        if math.isinf(self.fixed_s) or self._history.restarts != self._restarts:
            self._restart(X_WN, fix)
            return True
        age_s = max(0.0, fix.stamp_s - self.fixed_s)
        distance_m, angle_rad = _apart(X_WN, self.X_WN, X_NB)
        if self._thrown_over:
            self.jumps += distance_m > GATE_M or angle_rad > GATE_RAD
            self._restart(X_WN, fix)
            return True
        if distance_m > GATE_M + DRIFT_M_S * age_s or angle_rad > GATE_RAD + DRIFT_RAD_S * age_s:
            return self._doubt(X_WN, X_NB, fix)
        self._suspects = 0
        share = 1.0 - math.exp(-age_s / SMOOTHING_S)
        self._pose = _towards(self._pose, X_WN, X_NB, share)
        self.fixed_s, self.covariance = fix.stamp_s, fix.covariance
        return True

    def throw_over(self) -> None:
        """Believe the next fix, wherever it is: whoever made it was lost, and knows that."""
        self._thrown_over = True

    def _doubt(self, X_WN: SE3, X_NB: SE3, fix: PoseFix) -> bool:
        """Reject, unless enough fixes in a row say the same."""
        agrees = False
        if self._suspect is not None:
            distance_m, angle_rad = _apart(X_WN, self._suspect, X_NB)
            agrees = distance_m < GATE_M and angle_rad < GATE_RAD
        self._suspects = self._suspects + 1 if agrees else 1
        self._suspect = X_WN
        if self._suspects < FIXES_TO_JUMP:
            self.rejected += 1
            return False
        self.jumps += 1
        self._restart(X_WN, fix)
        return True

    def _restart(self, X_WN: SE3, fix: PoseFix) -> None:
        self._pose = X_WN
        self.fixed_s, self.covariance = fix.stamp_s, fix.covariance
        self.source = fix.source
        self._restarts = self._history.restarts
        self._suspects, self._thrown_over = 0, False


def _between(X_WB: SE3, X_NB: SE3) -> SE3:
    """X_WN with z up that takes one base position onto the other, headings too."""
    yaw_rad = (X_WB @ X_NB.inverse()).yaw_rad
    return _placed(X_WB.p, yaw_rad, X_NB)


def _placed(p_WB: tuple[float, float, float], yaw_rad: float, X_NB: SE3) -> SE3:
    """X_WN of a heading under which the base is at p_WB."""
    turn = SE3.from_xy_yaw(0.0, 0.0, yaw_rad).quat_wxyz
    x, y, z = rotate(turn, X_NB.p)
    return SE3((p_WB[0] - x, p_WB[1] - y, p_WB[2] - z), turn)


def _apart(first: SE3, second: SE3, X_NB: SE3) -> tuple[float, float]:
    """How far two X_WN put the base apart [m], and their headings [rad]."""
    distance_m = math.dist((first @ X_NB).p, (second @ X_NB).p)
    return distance_m, abs(wrap_angle(first.yaw_rad - second.yaw_rad))


def _towards(X_WN: SE3, measured: SE3, X_NB: SE3, share: float) -> SE3:
    """Move an estimate by a share of its error at the base, where the fix was measured."""
    old, new = (X_WN @ X_NB).p, (measured @ X_NB).p
    x, y, z = (a + share * (b - a) for a, b in zip(old, new, strict=True))
    turn_rad = wrap_angle(measured.yaw_rad - X_WN.yaw_rad)
    return _placed((x, y, z), X_WN.yaw_rad + share * turn_rad, X_NB)


def _finite(X: SE3) -> bool:
    return all(math.isfinite(value) for value in (*X.p, *X.quat_wxyz))
