"""`dynamixel-sdk`, which nobody here wrote, drives emulated servos through a serial port."""

import termios
from collections.abc import Iterator
from pathlib import Path

import pytest

from robot.clock import WallClock
from sim.devices.dynamixel import Kind, Servo
from sim.devices.serial_line import Line
from sim.devices.serial_server import SerialServer
from sim.devices.shaft import FreeShaft
from tests.fakes.served import Playing, until

sdk = pytest.importorskip("dynamixel_sdk")
KIND = Kind(1020, 4.1, 2.3, 4.8, 2.69e-3, 1193)


class Served(Playing):
    """Two servos behind a terminal, played by a thread."""

    def __init__(self, folder: Path) -> None:
        clock = WallClock()
        self.line = Line(baud_hz=1_000_000, now_s=clock.now_s())
        self.servos = [
            Servo(KIND, FreeShaft(inertia_kg_m2=0.02), number, now_s=clock.now_s())
            for number in (1, 2)
        ]
        self.line.servos += self.servos
        self.path = folder / "dxl0"
        super().__init__(SerialServer([(self.path, self.line)], clock))


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served(tmp_path)
    yield made
    made.close()


@pytest.fixture
def port(served: Served):
    opened = sdk.PortHandler(str(served.path))
    assert opened.setBaudRate(1_000_000)
    yield opened
    opened.closePort()


def test_it_finds_them_switches_them_on_and_moves_them(served: Served, port):
    ask = sdk.PacketHandler(2.0)
    until(lambda: ask.ping(port, 1) == (1020, sdk.COMM_SUCCESS, 0))
    until(lambda: ask.write1ByteTxRx(port, 1, 11, 3) == (sdk.COMM_SUCCESS, 0))
    until(lambda: ask.write1ByteTxRx(port, 1, 64, 1) == (sdk.COMM_SUCCESS, 0))
    until(lambda: ask.write1ByteTxRx(port, 1, 11, 0) == (sdk.COMM_SUCCESS, 7))  # locked
    until(lambda: ask.write4ByteTxRx(port, 1, 116, 2500) == (sdk.COMM_SUCCESS, 0))
    until(lambda: abs(ask.read4ByteTxRx(port, 1, 132)[0] - 2500) < 10)
    assert served.servos[0].is_on
    assert not served.servos[1].is_on


def test_it_reads_and_writes_both_at_once(served: Served, port):
    ask = sdk.PacketHandler(2.0)
    write = sdk.GroupSyncWrite(port, ask, 84, 2)
    for number in (1, 2):
        write.addParam(number, [number, 1])
    read = sdk.GroupSyncRead(port, ask, 84, 2)
    for number in (1, 2):
        read.addParam(number)
    until(
        lambda: write.txPacket() == sdk.COMM_SUCCESS and served.servos[1].memory.get(84, 2) == 258
    )
    for run in (read.txRxPacket, read.fastSyncRead):
        until(lambda run=run: run() == sdk.COMM_SUCCESS)
        assert [read.getData(number, 84, 2) for number in (1, 2)] == [257, 258]


def test_at_another_bit_rate_nobody_hears_it(served: Served):
    port = sdk.PortHandler(str(served.path))
    assert port.setBaudRate(57_600)
    try:
        for _ in range(3):
            assert sdk.PacketHandler(2.0).ping(port, 1)[1] != sdk.COMM_SUCCESS
    finally:
        port.closePort()


def test_a_port_that_is_unplugged_hangs_up(served: Served, port):
    ask = sdk.PacketHandler(2.0)
    until(lambda: ask.ping(port, 2)[1] == sdk.COMM_SUCCESS)
    served.between_steps(lambda: served.server.unplug(0))
    for act in (port.clearPort, lambda: port.writePort(b"x"), lambda: port.readPort(1)):
        with pytest.raises((OSError, termios.error)):  # pyserial lets either through
            act()
