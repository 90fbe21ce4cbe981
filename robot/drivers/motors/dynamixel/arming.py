"""Enabling all servos or none, and leaving them so that they brake by themselves."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from robot.drivers.motors.dynamixel import control_table as table
from robot.drivers.motors.dynamixel import instructions
from robot.drivers.motors.dynamixel.control_table import Item
from robot.drivers.motors.dynamixel.joint_map import JointServo, ServoMap
from robot.drivers.motors.dynamixel.models import RAD_S_A_STEP
from robot.drivers.motors.dynamixel.talking import WAITS_S, Talk
from robot.errors import DriverError

DAMPING_NM_S = 2.0
"""Of a joint that nobody commands any more; less where the servo cannot."""
MOST_GAIN = 16_383


def arm(talk: Talk) -> None:
    """Set modes, switch torque on, with no current, and see that watchdogs can be set.

    Watchdogs are off after it: `watchdogs` goes with the first command. Servos that another program
    left on, in the mode of currents, stay on, and one question is all that it takes.

    Raises:
        DriverError: naming each servo that did not do so, and why; then all are switched off.
    """
    told = _read(talk, table.RETURN_DELAY.address, table.TORQUE_ENABLE.end)
    other = {name for name in talk.joints.joints if name not in told or _is_other(told[name])}
    write(talk, table.BUS_WATCHDOG, lambda _: 0)
    if not other and all(_is_on(answer) for answer in told.values()):
        return
    write(talk, table.TORQUE_ENABLE, lambda _: 0, only=other)
    write(talk, table.OPERATING_MODE, lambda _: table.CURRENT_MODE, only=other)
    write(talk, table.RETURN_DELAY, lambda _: 0, only=other)
    write(talk, table.GOAL_CURRENT, lambda _: 0)
    write(talk, table.TORQUE_ENABLE, lambda _: 1)
    steps = talk.joints.watchdog_steps
    write(talk, table.BUS_WATCHDOG, lambda _: steps)
    refused = [*_refused(talk, steps)]
    write(talk, table.BUS_WATCHDOG, lambda _: 0)
    if refused:
        write(talk, table.TORQUE_ENABLE, lambda _: 0)
        raise DriverError(f"all servos are switched off again: {', '.join(refused)}")


def watchdogs(joints: ServoMap) -> dict[str, bytes]:
    """What sets the watchdogs of all servos, by port."""
    return _packets(joints, table.BUS_WATCHDOG, lambda _: joints.watchdog_steps, only=None)


def _is_other(answer: bytes) -> bool:
    begin = table.RETURN_DELAY.address
    mode = table.OPERATING_MODE.value(answer, begin)
    return mode != table.CURRENT_MODE or table.RETURN_DELAY.value(answer, begin) != 0


def _is_on(answer: bytes) -> bool:
    return bool(table.TORQUE_ENABLE.value(answer, table.RETURN_DELAY.address))


def _refused(talk: Talk, steps: int) -> list[str]:
    wanted = (
        (table.OPERATING_MODE, table.CURRENT_MODE, "is not in the mode of currents"),
        (table.RETURN_DELAY, 0, "keeps its return delay"),
        (table.TORQUE_ENABLE, 1, "does not give torque (a hardware error? reboot it)"),
        (table.BUS_WATCHDOG, steps, "did not take its watchdog"),
    )
    begin = table.RETURN_DELAY.address
    told = _read(talk, begin, table.BUS_WATCHDOG.end)
    wrong: list[str] = []
    for name in talk.joints.joints:
        if name not in told:
            wrong.append(f"{name} does not answer (power, cable, id)")
            continue
        wrong += [
            f"{name} {what}"
            for item, value, what in wanted
            if item.value(told[name], begin) != value
        ]
    return wrong


def leave_braking(talk: Talk) -> None:
    """Let every servo hold its speed at zero, softly, for itself, with no watchdog.

    The mode is changed for that, and torque is off for as long as it takes, some milliseconds.
    """
    write(talk, table.BUS_WATCHDOG, lambda _: 0)
    write(talk, table.TORQUE_ENABLE, lambda _: 0)
    write(talk, table.OPERATING_MODE, lambda _: table.VELOCITY_MODE)
    write(talk, table.VELOCITY_I, lambda _: 0)
    write(talk, table.VELOCITY_P, braking_gain)
    write(talk, table.TORQUE_ENABLE, lambda _: 1)
    write(talk, table.GOAL_VELOCITY, lambda _: 0)


def switch_off(talk: Talk) -> list[str]:
    """Let every servo go, so that it gives no torque; the joints that were not seen to do so."""
    names = talk.joints.joints
    still = set(names)
    write(talk, table.GOAL_CURRENT, lambda _: 0)
    for _ in WAITS_S:
        write(talk, table.TORQUE_ENABLE, lambda _: 0, only=still)
        told = _read(talk, table.RETURN_DELAY.address, table.TORQUE_ENABLE.end)
        still = {name for name in names if name not in told or _is_on(told[name])}
        if not still:
            break
    # Who was not seen to keeps its watchdog: if it hears nothing any more, that lets it go.
    write(talk, table.BUS_WATCHDOG, lambda _: 0, only=set(names) - still)
    return [name for name in names if name in still]


def braking_gain(joint: JointServo) -> int:
    """The P gain of its velocity loop: P / 128 steps of current a step of velocity (e-manual)."""
    wanted_nm_s = DAMPING_NM_S / (joint.gear * joint.gear)
    return min(MOST_GAIN, max(1, round(128.0 * wanted_nm_s * RAD_S_A_STEP / joint.sold.nm_a_step)))


def write(
    talk: Talk, item: Item, value: Callable[[JointServo], int], *, only: set[str] | None = None
) -> None:
    """Write an item into all servos, or only into these: of each port all at once."""
    if packets := _packets(talk.joints, item, value, only=only):
        talk.tell(packets)


def _packets(
    joints: ServoMap, item: Item, value: Callable[[JointServo], int], *, only: set[str] | None
) -> dict[str, bytes]:
    packets: dict[str, bytes] = {}
    for port in joints.ports:
        data = {
            one.id: item.packed(value(one))
            for name, one in joints.on(port).items()
            if only is None or name in only
        }
        if data:
            packets[port] = instructions.sync_write(item.address, data)
    return packets


def _read(talk: Talk, begin: int, end: int) -> Mapping[str, bytes]:
    """Bytes of all servos, of those that told; who did not is asked again, behind the others."""
    joints = talk.joints
    missing = {
        port: {one.id: name for name, one in joints.on(port).items()} for port in joints.ports
    }
    told: dict[str, bytes] = {}
    for wait_s in WAITS_S:
        asked = {
            port: instructions.sync_read([*names], begin, end - begin)
            for port, names in missing.items()
            if names
        }
        if not asked:
            break
        counts = {port: len(missing[port]) for port in asked}
        for port, heard in talk.ask(asked, counts, wait_s=wait_s).items():
            for status in heard:
                if len(status.data) == end - begin and status.id in missing[port]:
                    told[missing[port].pop(status.id)] = status.data
        for port, names in missing.items():  # a servo that is missing silences those behind it
            first = [*names][:1]
            missing[port] = {**{one: names[one] for one in names if one not in first},
                             **{one: names[one] for one in first}}  # fmt: skip
    return told
