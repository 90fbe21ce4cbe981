"""What `humanoid motors` does with hobby servos, and with no others (`motor_families`)."""

from __future__ import annotations

from robot.bringup.motor_family import AnyMotors
from robot.bringup.motor_reports import Reading, Seen
from robot.clock import Clock
from robot.drivers.motors.findings import Finding
from robot.drivers.motors.motor_map import Motor
from robot.drivers.motors.pwm.chips import Chips
from robot.drivers.motors.pwm.joint_map import PulseMap
from robot.drivers.motors.pwm.pca9685 import OFF
from robot.errors import DriverError

PULSES, NO_PULSE = "pulses", "no_pulse"
NOTHING = "a hobby servo does not say where it is"


def findings(_ports: Chips, _clock: Clock, _joints: PulseMap) -> list[Finding]:
    """What nobody can put right: that chips answer was seen as they were reached."""
    return [
        Finding(
            "all",
            "assumed",
            "nothing is measured: where joints are is where they were sent",
            "look at the joints themselves",
            is_grave=False,
        ),
        Finding(
            "all",
            "no_watchdog",
            "a PCA9685 has no watchdog: its servos go on as they were told when the computer dies",
            "wire its OE pin to the contact of an emergency stop",
            is_grave=False,
        ),
    ]


def scan(ports: Chips, _clock: Clock, joints: PulseMap, _up_to: int) -> list[Seen]:
    """The chips of the map: they answered, or they could not have been reached."""
    return [
        Seen(
            bus=name, id=joints.chips[name].address, reply_id=joints.chips[name].address,
            replies=1, joint=", ".join(joints.on(name)), mode=None, version=None, ranges=None,
        )
        for name in ports.outputs()
    ]  # fmt: skip


def readings(ports: Chips, _clock: Clock, joints: PulseMap) -> list[Reading]:
    """Whether each servo gets pulses: where it is it does not say."""
    told: dict[str, bool] = {}
    for chip, counts in ports.outputs().items():
        ours = joints.on(chip)
        first = min(one.id for one in ours.values())
        for name, one in ours.items():
            told[name] = counts is not None and counts[one.id - first] != OFF
    return [
        Reading(
            joint=name, bus=one.chip, id=one.id, model=one.model,
            status=PULSES if told[name] else NO_PULSE,
        )
        for name, one in joints.joints.items()
    ]  # fmt: skip


def bare(joint: Motor) -> Motor:
    """The joint as it is: nobody gets here, since its servo measures nothing."""
    return joint


def resting(driver: AnyMotors, _ports: Chips, _clock: Clock) -> str:
    """What is known of the only joint's servo; "" where it gets no pulse."""
    status = driver.status_of(0)
    return "" if status == NO_PULSE else status


def set_zero(_ports: Chips, _clock: Clock, _joints: PulseMap, _at_rad: float) -> None:
    """Raises DriverError: it has none to set."""
    raise DriverError(f"{NOTHING} (correct offset_rad in the map)")
