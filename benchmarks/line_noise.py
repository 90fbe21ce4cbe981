"""`python -m benchmarks.line_noise`: a million spoilt frames or packets into each driver's ears.

Emulated motors talk for a moment; what they said is then heard again with bits turned, bytes that
are anything, cut, and mixed with noise alone. Nothing may raise, hold up the driver, or put a joint
where no number is. Counted: frames, how many were believed at all, the longest single look.
"""

from __future__ import annotations

import itertools
import tempfile
import time
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import numpy.typing as npt
import typer

from benchmarks import can_buses, dynamixel_ports, ethernet_boards
from robot.clock import SimulatedClock
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.joint_map import load as load_can
from robot.drivers.motors.can.packed import size_on
from robot.drivers.motors.dynamixel import load as wire
from robot.drivers.motors.dynamixel.driver import DynamixelMotors
from robot.drivers.motors.dynamixel.joint_map import load as load_servos
from robot.drivers.motors.dynamixel.packets import Receiver
from robot.drivers.motors.ethernet.datagrams import LEAST, Kind
from robot.drivers.motors.ethernet.driver import EthernetMotors
from robot.drivers.motors.ethernet.joint_map import load as load_boards
from sim.devices import bench, direct, ethernet_bench, servo_bench

TALKS = 60
"""Periods in which motors talk."""
A_LOOK = 32
"""Frames that come in at once, from each line."""
FLIPPED, ANYTHING, CUT, NOISE = 0.02, 0.05, 0.1, 0.2
"""Of bits, of bytes, of frames whose end is missing, and of frames that are noise alone."""


@dataclass
class Heard:
    """What one driver made of it.

    Attributes:
        frames: that came in.
        believed: of the motors' own words, that changed what is known of a joint.
        longest_ms: that one look took, of the processor.
    """

    frames: int = 0
    believed: int = 0
    longest_ms: float = 0.0


Ear = Callable[[str, list[bytes], float], None]


def spoilt(
    said: list[bytes], draw: np.random.Generator, count: int, *, cuts: bool
) -> Iterator[list[bytes]]:
    """So many frames, a look at a time; `cuts`: whether a frame may come in part."""
    done = 0
    while done < count:
        which: list[int] = draw.integers(len(said), size=A_LOOK).tolist()
        batch = [said[index] for index in which]
        yield [_spoilt(one, draw, cuts=cuts) for one in batch]
        done += A_LOOK


def _spoilt(frame: bytes, draw: np.random.Generator, *, cuts: bool) -> bytes:
    data: npt.NDArray[np.uint8] = np.frombuffer(frame, np.uint8).copy()
    chance = draw.random(3)
    if chance[0] < NOISE:
        data = draw.integers(0, 256, len(data), np.uint8)
    elif chance[0] < 2 * NOISE:
        data[draw.random(len(data)) < ANYTHING] = draw.integers(256)
    else:
        turned = (draw.random((len(data), 8)) < FLIPPED * draw.random()) * (1 << np.arange(8))
        data ^= turned.sum(axis=1).astype(np.uint8)
    if cuts and chance[1] < CUT:
        data = data[: int(chance[2] * len(data))]
    return data.tobytes()


def play(driver: Any, ports: Any, hears: str, ear: Ear, *, count: int, cuts: bool) -> Heard:
    """Let motors talk, then hear it spoilt.

    Args:
        driver: of the family.
        ports: its lines, straight to emulated motors.
        hears: the method of `ports` by which words come in.
        ear: takes frames of a line as the driver does.
        count: of frames.
        cuts: whether frames may come in part.
    """
    said: dict[str, list[bytes]] = {}
    listened = getattr(ports, hears)

    def listening(*line: str) -> Any:
        came = listened(*line)
        for name, data in [(line[0], came)] if line else came:
            if data:
                said.setdefault(name, []).append(bytes(data))
        return came

    setattr(ports, hears, listening)
    clock, heard = driver._clock, Heard()
    with driver:
        zero = np.zeros(len(driver.joints.joints))
        asked = [zero == 0.0] if isinstance(driver, DynamixelMotors) else []
        for _ in range(TALKS):
            driver.write(MotorCommand(clock.now_s(), zero, zero, zero, zero + 5.0, zero + 0.5))
            driver.read()
        draw, known = np.random.default_rng(18), driver.reception
        lines = sorted(said)
        noise = {name: spoilt(said[name], draw, count // len(lines), cuts=cuts) for name in lines}
        now_s = clock.now_s()
        for looks in zip(*noise.values(), strict=True):
            now_s += driver.joints.period_s
            before = known.heard_s.copy()
            for name, frames in zip(lines, looks, strict=True):
                begun_s = time.thread_time()
                ear(name, frames, now_s)
                heard.longest_ms = max(heard.longest_ms, 1e3 * (time.thread_time() - begun_s))
                heard.frames += len(frames)
            heard.believed += int(np.count_nonzero(known.heard_s != before))
            known.end_period(*asked)
            if not (np.isfinite(known.q).all() and np.isfinite(known.qd).all()):
                raise ValueError("a joint is where no number is")
    return heard


def can(text: str, count: int) -> Heard:
    """Of a map of motors on CAN."""
    joints, clock = _loaded(load_can, text), SimulatedClock()
    ports = direct.DirectPorts(bench.build(joints), clock)
    driver = CanMotors(joints, clock, ports=lambda: ports)
    sizes = {name: size_on(is_fd=bus.is_fd) for name, bus in joints.buses.items()}

    def ear(bus: str, frames: list[bytes], now_s: float) -> None:
        whole = b"".join(frames)
        if len(whole) % sizes[bus]:
            raise ValueError("an interface gives whole frames")
        driver.reception.take([(bus, whole)], now_s)

    return play(driver, ports, "receive_packed", ear, count=count, cuts=False)


def dynamixel(text: str, count: int) -> Heard:
    """Of a map of servos: bytes of a port."""
    joints, clock = _loaded(load_servos, text), SimulatedClock()
    ports = servo_bench.DirectPorts(servo_bench.build(joints), clock)
    driver = DynamixelMotors(joints, clock, ports=lambda: ports)
    receiver = Receiver()

    def ear(port: str, frames: list[bytes], now_s: float) -> None:
        for number, frame in enumerate(frames):
            receiver.expect((wire.SHORT, wire.LONG, None)[number % 3])
            driver.reception.take(port, receiver.take(frame), now_s)
        driver.reception.take(port, receiver.give_up(), now_s)

    return play(driver, ports, "read", ear, count=count, cuts=True)


def ethernet(text: str, count: int) -> Heard:
    """Of a map of boards: datagrams."""
    joints, clock = _loaded(load_boards, text), SimulatedClock()
    ports = ethernet_bench.DirectPorts(ethernet_bench.build(joints), clock)
    driver = EthernetMotors(joints, clock, ports=lambda: ports)

    asked = itertools.count(1000)

    def ear(board: str, frames: list[bytes], now_s: float) -> None:
        driver.reception.expect(Kind.COMMAND, sequence := next(asked))
        forged = [_forged(frame, sequence) for frame in frames[::2]]
        driver.reception.take([(board, one) for one in (*forged, *frames[1::2])], now_s)

    return play(driver, ports, "receive", ear, count=count, cuts=True)


def _forged(frame: bytes, sequence: int) -> bytes:
    """The answer that is waited for, with a CRC that is right: what else it says is spoilt."""
    if len(frame) < LEAST:
        return frame
    begin = frame[:16] + sequence.to_bytes(4, "little") + frame[20:-4]
    return begin + zlib.crc32(begin).to_bytes(4, "little")


def _loaded(load: Callable[[Path], Any], text: str) -> Any:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "map.yaml"
        file.write_text(text)
        return load(file)


_CAN = can_buses.map_text(2, 4, 500)
_FD = _CAN.replace("}\n  bus", ", data_bitrate_hz: 5000000}\n  bus").replace(
    "}\njoints", ", data_bitrate_hz: 5000000}\njoints"
)
_SOLD = "moteus-x1, ranges: {position_rad: 12.5, velocity_rad_s: 30, torque_nm: 60}"
FAMILIES: dict[str, Callable[[int], Heard]] = {
    "damiao": lambda count: can(_CAN, count),
    "robstride": lambda count: can(_CAN.replace("DM8009", "RS03"), count),
    "moteus": lambda count: can(_FD.replace("DM8009", _SOLD), count),
    "dynamixel": lambda count: dynamixel(
        dynamixel_ports.map_text(2, 4, rate_hz=200, baud_hz=2_000_000), count
    ),
    "ethernet": lambda count: ethernet(ethernet_boards.map_text(2, 4, rate_hz=500), count),
}


def main(
    *,
    frames: Annotated[int, typer.Option(min=1000, help="of each family")] = 1_000_000,
    only: Annotated[str, typer.Option(help=f"one of {', '.join(FAMILIES)}")] = "",
) -> None:
    """Hear, and count."""
    if only and only not in FAMILIES:
        raise typer.BadParameter(f"there are {', '.join(FAMILIES)}")
    for name in [only] if only else FAMILIES:
        heard = FAMILIES[name](frames)
        print(
            f"{name:10} {heard.frames} frames, none raised; {heard.believed} changed what is known "
            f"of a joint; the longest look at {A_LOOK} took {heard.longest_ms:.1f} ms of CPU",
            flush=True,
        )


if __name__ == "__main__":
    typer.run(main)
