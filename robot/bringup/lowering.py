"""What is done with a robot that nobody commands any more: it squats, then its motors damp."""

from __future__ import annotations

from robot.bringup.body_clock import BodyClock
from robot.bus.bus import Bus
from robot.bus.run import Run
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import Clock
from robot.link import BodyLink, BusLink
from robot.messages import Damp, Stand
from robot.model import description

LOW_SHARE = 0.7
"""Of the standing height: about as low as it can squat."""
FIRST_STATE_S, SQUAT_S, SETTLE_S = 2.0, 8.0, 0.5
POLL_S = 0.02


def lower(run: Run, *, clock: Clock) -> str:
    """Take the dead executive's place on the bus and lower the robot; returns what became of it."""
    height_m = LOW_SHARE * description.load(run.robot).walking.base_height_m
    with ZenohBus("executive", run.sockets) as bus:
        return _lower(bus, height_m, clock)


def _lower(bus: Bus, height_m: float, clock: Clock) -> str:
    link = BusLink(bus, BodyClock(bus, clock))
    body = link.body()
    until_s = clock.now_s() + FIRST_STATE_S
    while (body := link.body()) is None and clock.now_s() < until_s:
        clock.sleep_until(clock.now_s() + POLL_S)
    if body is None:
        return "the controller does not answer; the motors damp by their own watchdog"
    if body.mode in ("fallen", "damping"):
        return f"the robot was already {body.mode}"
    squatted = _squat(link, height_m, clock)
    link.send(Damp(id=link.next_id(), stamp_s=link.now_s()))
    clock.sleep_until(clock.now_s() + SETTLE_S)
    return "the robot squatted; its motors damp" if squatted else "its motors damp"


def _squat(link: BodyLink, height_m: float, clock: Clock) -> bool:
    """Finish the step and squat; False if it is not down in time."""
    command = Stand(id=link.next_id(), stamp_s=link.now_s(), height_m=height_m)
    link.send(command)
    until_s = clock.now_s() + SQUAT_S
    while clock.now_s() < until_s:
        clock.sleep_until(clock.now_s() + POLL_S)
        body = link.body()
        legs = body.activities.get("legs") if body else None
        if legs is not None and legs.id == command.id and legs.status != "running":
            return legs.status == "done"
    return False
