"""Postures: stand, squat, lean, stand on one leg, hold against pushes."""

from __future__ import annotations

from typing import Literal

from msgspec.structs import replace

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.get_up import get_up
from executive.skills.motions.script import Script, give_up
from executive.skills.motions.walk import stand_still
from executive.skills.parameters import SkillParams, lasting
from executive.skills.scripted import ScriptedSkill
from robot.failures import Failure, failure
from robot.messages import OneLeg, Side, WorldMap
from robot.model.description import RobotDescription

BalanceMode = Literal["stand", "get_up", "squat", "one_leg", "lean", "hold"]

SHIFT_S = 8.0
STANDING = ("stand", "get_up", "hold")


class BalanceParams(SkillParams, frozen=True, kw_only=True):
    """Take a posture and hold it. To stand, only "get_up" leaves the floor if the robot lies there.

    `side` is the leg stood on, or with "lean" the side leant to; a lean without one is forward.
    """

    mode: BalanceMode
    side: Literal["left", "right", "forward", "backward"] | None = None
    duration_s: float = 3.0

    def __post_init__(self) -> None:
        """Check the span and the side."""
        lasting(self.duration_s)
        if self.mode == "one_leg" and self.side not in (None, "left", "right"):
            raise ValueError(f"a leg is left or right, not {self.side}")


class Balance(ScriptedSkill[BalanceParams]):
    """Take a posture, hold it for its time, and stand again."""

    name = "balance"
    summary = "stand, squat, lean, stand on one leg, get up"
    takes = BalanceParams
    resources = frozenset({"legs"})

    @classmethod
    def lack(cls, wanted: BalanceParams, robot: RobotDescription) -> str:
        """A way to get up, or a waist to lean with."""
        if wanted.mode == "get_up":
            return "" if robot.getting_up else "knows no way to get up"
        bends = wanted.mode != "lean" or robot.groups["waist"]
        return "" if bends else "has no waist to lean with"

    @classmethod
    def refusal(
        cls, wanted: BalanceParams, world_map: WorldMap, robot: RobotDescription
    ) -> Failure | None:
        """What is too long for one leg."""
        most_s = robot.balance.max_one_leg_s
        if wanted.mode != "one_leg" or wanted.duration_s <= most_s:
            return None
        text = f"{wanted.duration_s:g} s on one leg is too long: at most {most_s:g} s"
        return failure("invalid_goal", text)

    @classmethod
    def forecast(cls, wanted: BalanceParams, outlook: Outlook) -> Forecast:
        """Taking the posture, holding it, standing again."""
        there_and_back_s = float(getattr(outlook.robot.paces.postures_s, wanted.mode))
        return Forecast(wanted.duration_s + there_and_back_s)

    def __init__(self, parameters: BalanceParams, context: SkillContext) -> None:
        """Which posture, for how long."""
        super().__init__(parameters, context)
        self._held_s = 0.0

    def script(self) -> Script[None]:
        """Take it, hold it, stand."""
        body, wanted = self.body, self.parameters
        if wanted.mode == "get_up":
            yield from get_up(body)
        if wanted.mode == "one_leg":
            yield from self._one_leg("right" if wanted.side == "right" else "left")
            return
        body.phase = "standing" if wanted.mode in STANDING else f"going to {wanted.mode}"
        if wanted.mode == "squat":
            yield from stand_still(body, height_m=body.description.balance.squat_base_m)
        elif wanted.mode == "lean":
            yield from self._lean()
        else:
            yield from stand_still(body)
        yield from self._hold()
        if wanted.mode in ("squat", "lean"):
            body.phase = "standing up"
            yield from stand_still(body)

    def remaining(self) -> BalanceParams:
        """The same posture, for the time that is left."""
        left_s = max(0.0, self.parameters.duration_s - self._held_s)
        return replace(self.parameters, duration_s=left_s)

    def _lean(self) -> Script[None]:
        side, balance = self.parameters.side or "forward", self.body.description.balance
        if side in ("left", "right"):
            turn_rad = balance.turn_rad if side == "left" else -balance.turn_rad
            yield from stand_still(self.body, yaw_rad=turn_rad)
        else:
            forward = side == "forward"
            pitch_rad = balance.lean_forward_rad if forward else balance.lean_back_rad
            yield from stand_still(self.body, pitch_rad=pitch_rad)

    def _hold(self) -> Script[None]:
        """Stay for the time asked for; says when it is being pushed."""
        body, span_s = self.body, self.parameters.duration_s
        pushed_m_s = body.description.balance.pushed_m_s
        begin_s = body.now_s
        end_s = begin_s + span_s
        while body.now_s < end_s:
            self._held_s = body.now_s - begin_s
            vx, vy, _ = body.state.v_NB
            pushed = vx * vx + vy * vy > pushed_m_s**2
            body.phase = "holding against a push" if pushed else f"holding ({self.parameters.mode})"
            body.progress = 1.0 - (end_s - body.now_s) / span_s
            yield

    def _one_leg(self, side: Side) -> Script[None]:
        """Stand on one leg, and see that the other foot really left the floor."""
        body, span_s = self.body, self.parameters.duration_s
        body.phase = f"standing on the {side} leg"
        command = OneLeg(**body.header(), side=side, duration_s=span_s)
        body.send(command)
        end_s = body.now_s + span_s + SHIFT_S
        lifted_s = 0.0
        before_s = body.now_s
        while True:
            yield
            state = body.state
            on_it = state.left_contact if side == "left" else state.right_contact
            on_other = state.right_contact if side == "left" else state.left_contact
            if on_it and not on_other:
                lifted_s += body.now_s - before_s
            before_s = body.now_s
            self._held_s = lifted_s
            body.progress = min(1.0, lifted_s / max(span_s, 0.1))
            activity = body.activity("legs", command.id)
            if activity is not None and activity.status != "running":
                break
            if body.now_s > end_s:
                raise give_up("timeout", "did not come back to both feet in time")
        if activity.status == "failed" or lifted_s < 0.8 * span_s:
            raise give_up(
                "lost_balance",
                f"stood on the {side} leg for {lifted_s:.1f} s of {span_s:.1f} s: "
                + (activity.detail or "the other foot came down"),
                lifted_s=round(lifted_s, 2),
            )
