"""`python -m benchmarks.transport`: what it costs to get messages and motor commands across.

Zenoh: one way between two processes, sent 200 times a second, subscriber polling; both read the
same monotonic clock. Shared memory: one call each. `fast`: a period with a plant and a controller
that do nothing.
"""

from __future__ import annotations

import multiprocessing
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from robot.bringup.lockstep import Lockstep
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import SimulatedClock
from robot.closing import Closing
from robot.drivers.body_devices import BodyDevices
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MIT_MODE, MotorCommand, MotorState
from robot.drivers.simulation.shared_plant import PlantServer, SharedPlant
from robot.drivers.wiring import Wiring
from robot.messages import BodyState, DepthImage, Message
from robot.model import description
from robot.se3 import SE3

COUNT = 33
MESSAGES = 1000
CALLS = 20_000


def body_state(stamp_s: float) -> BodyState:
    joints = tuple(np.linspace(-1.0, 1.0, COUNT).tolist())
    zero = (0.0, 0.0, 0.0)
    return BodyState(
        stamp_s=stamp_s, mode="stand", X_NB=SE3(), v_NB=zero, w_NB=zero, X_NL=SE3(), X_NR=SE3(),
        X_NS=SE3(), left_contact=True, right_contact=True, q_rad=joints, qd_rad_s=joints,
        tau_nm=joints, com_N=zero, dcm_N=(0.0, 0.0), zmp_N=(0.0, 0.0), hands={}, activities={},
    )  # fmt: skip


def depth_image(stamp_s: float) -> DepthImage:
    return DepthImage(
        stamp_s=stamp_s, width=160, height=120, fovy_rad=1.0, depth_m=bytes(4 * 160 * 120)
    )


MAKERS: dict[str, tuple[topics.Topic[Message], Callable[[float], Message]]] = {
    "body state (50 Hz)": (topics.BODY_STATE, body_state),  # pyright: ignore
    "depth image, 77 kB (10 Hz)": (topics.DEPTH, depth_image),  # pyright: ignore
}


def send(folder: str, name: str, stop: object) -> None:
    """The other process: stamps are the time of sending."""
    topic, make = MAKERS[name]
    with ZenohBus("controller", folder) as bus:
        while not stop.is_set():  # pyright: ignore
            bus.publish(topic, make(time.monotonic()))
            time.sleep(0.005)


def zenoh_one_way(name: str) -> list[float]:
    """Latencies of one kind of message [s]."""
    context = multiprocessing.get_context("spawn")
    stop = context.Event()
    found: list[float] = []
    with tempfile.TemporaryDirectory(prefix="humanoid-") as folder:
        sender = context.Process(target=send, args=(folder, name, stop))
        sender.start()
        with ZenohBus("executive", folder) as bus:
            reader = bus.subscribe(MAKERS[name][0])
            while len(found) < MESSAGES:
                for message in reader.take():
                    found.append(time.monotonic() - message.stamp_s)
                time.sleep(20e-6)
        stop.set()
        sender.join()
    return found[MESSAGES // 10 :]


def cost(call: Callable[[], object]) -> list[float]:
    """Durations of single calls [s]."""
    durations: list[float] = []
    for _ in range(CALLS):
        begin = time.perf_counter()
        call()
        durations.append(time.perf_counter() - begin)
    return durations


class Still(Closing):
    """A plant, a controller and a perception that do nothing."""

    def __init__(self) -> None:
        n = np.zeros(COUNT)
        self.sample = BodySample(
            MotorState(0.0, n, n, n, n, n, watchdog=False, command_stamp_s=0.0),
            ImuReading(0.0, np.zeros(3), np.zeros(3)),
            ForceReading(0.0, np.zeros((2, 6)), np.zeros((2, 6))),
        )
        self.command = MotorCommand.damping(COUNT, 0.0)
        self.body = body_state(0.0)

    def read(self) -> BodySample:
        """Always the same."""
        return self.sample

    def write(self, command: MotorCommand) -> MotorCommand:
        """Taken as it is."""
        return command

    def step(self, count: int = 1) -> None:
        """Nothing moves."""

    def open(self) -> None:
        """Nothing to reach."""

    def close(self) -> None:
        """Nothing to let go of."""

    def claim(self, driver: object) -> bool:  # noqa: ARG002
        """There is only one."""
        return True

    def release(self, driver: object) -> None:
        """There is no other."""

    def sense(self, now_s: float) -> list[tuple[topics.Topic[Message], Message]]:  # noqa: ARG002
        """Nothing is ever due."""
        return []

    def handle(self, command: object) -> None:
        """Nothing to do."""

    def tick(self, sample: BodySample) -> MotorCommand:  # noqa: ARG002
        """Always the same."""
        return self.command

    def state(self) -> BodyState:
        """Always the same."""
        return self.body


def lockstep_period_s() -> float:
    """A 2 ms period of `fast` without plant, controller and perception [s]."""
    still, bus, clock = Still(), LocalBus(), SimulatedClock()
    wiring = Wiring(robot=description.load("juno"), clock=clock, bus=bus, plant=still)
    body = BodyDevices(wiring, needs=MIT_MODE)
    with Lockstep(still, lambda: still, still, body=body, bus=bus, clock=clock) as runtime:  # pyright: ignore
        runtime.advance(1.0)
        begin = time.process_time()
        runtime.advance(20.0)
        return (time.process_time() - begin) / 10_000


def say(name: str, durations: list[float]) -> None:
    p50, p99, p999 = (float(np.percentile(durations, share)) * 1e6 for share in (50, 99, 99.9))
    print(f"{name:44} p50 {p50:8.1f}  p99 {p99:8.1f}  p99.9 {p999:8.1f} µs")


def main() -> None:
    for name in MAKERS:
        say(f"zenoh one way, {name}", zenoh_one_way(name))
    still, robot = Still(), description.load("juno")
    with tempfile.TemporaryDirectory() as folder:
        server = PlantServer(robot, Path(folder))
        server.publish(still.sample)
        clock = SimulatedClock()
        plant = SharedPlant(robot, Path(folder), clock=clock)
        wiring = Wiring(robot=robot, clock=clock, bus=LocalBus(), plant=plant)
        with BodyDevices(wiring, needs=MIT_MODE) as body:
            say("shared memory, publish a sample", cost(lambda: server.publish(still.sample)))
            say("shared memory, write a command", cost(lambda: body.write(still.command)))

            def both() -> None:
                server.publish(still.sample)
                body.read()

            say("shared memory, publish and read a sample", cost(both))
    print(f"{'fast: overhead of one 2 ms period':44} {lockstep_period_s() * 1e6:12.1f} µs CPU")


if __name__ == "__main__":
    main()
