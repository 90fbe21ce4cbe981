"""What the owner of the buses sends in each period: the controller's command, or its own.

It has no clock of its own: time is that of the motors' states.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.holding import Holding
from robot.drivers.motors.owned.memory import Order
from robot.model.body import BodyModel
from robot.owner import reactions
from robot.owner.balancing import Balancing
from robot.owner.reactions import Refused, Signs, State
from robot.owner.sit import Sitting, Squat
from robot.owner.standing import Rest, is_even, is_on_its_feet, stands

CLOSE_RAD = 0.12
"""Legs that differ more from a squat's, as where a foot is before the other, stay where balance
brought them: the squat would lead them out of it."""
ON_FEET_S = 0.1
"""So long it counts on that it was on its feet: a foot that touches down shakes the IMU."""


class Since:
    """For how long something has been so [s], 0 where it is not."""

    def __init__(self) -> None:
        """It is not."""
        self._from_s: float | None = None

    def look(self, now_s: float, *, is_so: bool) -> float:
        """Whether it is so now; returns for how long, at least a little where it is."""
        if not is_so:
            self._from_s = None
            return 0.0
        if self._from_s is None:
            self._from_s = now_s
        return max(now_s - self._from_s, 2 * reactions.SLACK_S)


class BusOwner:
    """Decides, period by period.

    Attributes:
        state: where on the ladder it is.
        peak: the largest torque measured since it acts alone, as a share of the joint's limit.
        stale: commands that came after their deadline, and were not carried out.
    """

    def __init__(
        self,
        body: BodyModel,
        squat: Squat | None,
        balances: Callable[[], Balancing] | None = None,
    ) -> None:
        """Nothing was commanded yet.

        Args:
            body: the robot.
            squat: None if the robot knows none, and so damps.
            balances: makes what lowers it from a step; None: it damps there.
        """
        self._body, self._squat, self._makes = body, squat, balances
        self.stale = 0
        self.peak = 0.0
        self._forget()

    def _forget(self) -> None:
        self.state, self._signs = reactions.WELL, Signs()
        self._last: MotorCommand | None = None
        self._heard_s: float | None = None
        self._is_sent = self._was_on = False
        self._sitting: Sitting | None = None
        makes = None if self._squat is None else self._makes
        self._balancing = None if makes is None else makes()
        self._on_feet_at_s = -math.inf
        self._holding = Holding()
        self._astray, self._lowering, self._seated = Since(), Since(), Since()
        self._damping, self._let_go, self._stop = Since(), Since(), Since()
        self._on_feet = Since()
        self._rest, self._is_at_rest = Rest(), True
        self._claimed, self._claimed_at_s = Since(), -math.inf

    @property
    def is_waited_for(self) -> bool:
        """Whether a command is expected: a controller commands, and nothing is latched."""
        return self._heard_s is not None and not self.state.latched

    def decide(
        self, sample: BodySample, order: Order | None, *, is_pressed: bool, is_claimed: bool
    ) -> MotorCommand | None:
        """What to send in this period.

        Args:
            sample: what the body feels.
            order: a controller's new one, if there is one.
            is_pressed: whether the stop input is, or cannot be read.
            is_claimed: whether a controller that lives has claimed the motors.

        Returns:
            None: nothing, as nobody has commanded yet; the motors are not enabled then.
        """
        now_s = sample.motors.stamp_s
        is_fresh = order is not None and not is_pressed and self._take(order, now_s)
        self._signs = self._look(
            sample, is_fresh=is_fresh, is_pressed=is_pressed, is_claimed=is_claimed
        )
        self.state = reactions.after(self.state, self._signs)
        if self.state.level > Level.OK:
            share = np.abs(sample.motors.tau) / self._body.torque_limit_nm
            self.peak = max(self.peak, float(np.fmax.reduce(share)))  # NaN: it measures none
        elif not self.state.latched:
            self.peak = 0.0
        command = self._sent(sample)
        if command is not None:
            self._last, self._is_sent = command, True
        return command

    def reset(self, *, is_pressed: bool | None = None) -> State | Refused:
        """Forget all, if that is allowed now; the next controller enables the motors anew.

        `is_pressed`: what the stop input says by now; None: what it said in the last period.
        """
        signs = self._signs
        if is_pressed is not None:
            signs = signs._replace(stop_s=math.inf if is_pressed else 0.0)
        answer = reactions.reset(self.state, signs)
        if isinstance(answer, State):
            self._forget()
        return answer

    def _take(self, order: Order, now_s: float) -> bool:
        """Whether an order is to be carried out."""
        if now_s > order.deadline_s + reactions.SLACK_S:
            self.stale += 1
            return False
        if self.state.latched:
            return False
        self._last = order.command
        self._heard_s = None if order.leaves else now_s
        return True

    def _look(
        self, sample: BodySample, *, is_fresh: bool, is_pressed: bool, is_claimed: bool
    ) -> Signs:
        now_s, level = sample.motors.stamp_s, self.state.level
        silent_s = 0.0 if is_fresh or self._heard_s is None else now_s - self._heard_s
        self._was_on |= self._is_sent and not sample.motors.watchdog
        self._claimed_at_s = now_s if is_claimed else self._claimed_at_s
        lowering, balancing = level == Level.SIT, self._balancing
        if self._squat is not None:
            self._is_at_rest = self._rest.look(now_s, sample.motors.q[self._squat.legs])
        astray = not self._stands(sample)
        if balancing is not None:
            if is_on_its_feet(sample, self._body):
                self._on_feet_at_s = now_s
            if self._balances:
                astray = not balancing.is_up
        on_feet = now_s - self._on_feet_at_s < ON_FEET_S
        if self._sitting is not None:
            seated = lowering and self._sitting.is_over(now_s)
        else:
            seated = lowering and balancing is not None and balancing.is_low
        lets_go = self._was_on and sample.motors.watchdog
        return Signs(
            silent_s=silent_s,
            claimed_s=self._claimed.look(
                now_s, is_so=now_s - self._claimed_at_s < reactions.FREE_S
            ),
            astray_s=self._astray.look(now_s, is_so=astray),
            on_feet_s=self._on_feet.look(now_s, is_so=on_feet),
            lowering_s=self._lowering.look(now_s, is_so=lowering),
            seated_s=self._seated.look(now_s, is_so=seated),
            damping_s=self._damping.look(now_s, is_so=level == Level.DAMP),
            let_go_s=self._let_go.look(now_s, is_so=lets_go),
            stop_s=self._stop.look(now_s, is_so=is_pressed),
        )

    def _sent(self, sample: BodySample) -> MotorCommand | None:
        state, last, level = sample.motors, self._last, self.state.level
        now_s, count = state.stamp_s, self._body.count
        if last is None:
            return None  # also where the stop is pressed: the motors were never enabled
        if level < Level.HOLD:
            self._holding.forget()
            return last
        if level == Level.HOLD:
            return self._holding.decided(
                MotorCommand.damping(count, now_s), Level.HOLD, obeyed=last, q=state.q
            )
        if level == Level.SIT and self._squat is not None:
            return self._lowered(sample, last, self._squat)
        if level == Level.OFF:
            return MotorCommand.damping(count, now_s, 0.0)
        return MotorCommand.damping(count, now_s, self._body.kd)

    def _lowered(self, sample: BodySample, last: MotorCommand, squat: Squat) -> MotorCommand:
        """One period of the controlled sit: from a step with balance, then, standing, without."""
        now_s = sample.motors.stamp_s
        balancing = self._balancing
        if balancing is not None and self._balances and not self._is_low(sample, balancing, squat):
            return balancing.command(sample)
        if self._sitting is None:
            self._sitting = Sitting(self._body, squat, last, sample.motors.q, now_s=now_s)
        return self._sitting.at(now_s)

    def _is_low(self, sample: BodySample, balancing: Balancing, squat: Squat) -> bool:
        """Whether the rest of the way can be played: its feet are side by side, nearly."""
        near = squat.place(sample.motors.q)[1] < CLOSE_RAD
        return balancing.is_low and near and stands(sample, self._body, squat)

    @property
    def _balances(self) -> bool:
        """Whether it is being lowered from a step, and not yet by its squat."""
        return self.state.code in reactions.BALANCED and self._sitting is None

    def _stands(self, sample: BodySample) -> bool:
        """Whether the squat can begin here; where it can be balanced else, only at rest."""
        squat = self._squat
        if squat is None or not stands(sample, self._body, squat):
            return False
        if self._balancing is None or self._sitting is not None:
            return True
        return self._is_at_rest and is_even(sample)
