"""`damiao-motor`, which nobody here wrote, drives an emulated motor through python-can."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from robot.clock import WallClock
from sim.devices.damiao import Damiao
from sim.devices.server import CanServer
from sim.devices.shaft import FreeShaft
from sim.devices.wire import Wire
from tests.fakes.served import PATIENCE_S, Playing, until

can = pytest.importorskip("can")
damiao_motor = pytest.importorskip("damiao_motor")


class Served(Playing):
    """Two motors on a wire behind a socket, played by a thread."""

    def __init__(self, folder: Path) -> None:
        clock = WallClock()
        self.wire = Wire(now_s=clock.now_s())
        self.motors = [
            Damiao(self.wire, FreeShaft(friction_nm_s=0.02), i, 0x10 + i, 12.5, 30.0, 10.0)
            for i in (1, 2)
        ]
        self.path = folder / "can0"
        super().__init__(CanServer([(self.path, self.wire)], self.motors, clock))


@pytest.fixture
def served(tmp_path: Path) -> Iterator[Served]:
    made = Served(tmp_path)
    yield made
    made.close()


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_it_enables_moves_and_asks_them(served: Served):
    controller = damiao_motor.DaMiaoController(channel=str(served.path), bustype="humanoid")
    try:
        first = controller.add_motor(1, 0x11, "4310")
        second = controller.add_motor(2, 0x12, "4310")
        assert first.get_register(21, timeout=PATIENCE_S) == 12.5
        assert second.get_register(8, timeout=PATIENCE_S) == 2
        first.ensure_control_mode("MIT")
        first.set_can_timeout(30_000)
        until(lambda: served.motors[0].registers[9] == 600_000)
        controller.enable_all()
        until(lambda: all(motor.status == 1 for motor in served.motors))

        def goes_to(angle_rad: float) -> bool:
            first.send_cmd_mit(target_position=angle_rad, stiffness=20.0, damping=1.0)
            return first.get_states().get("pos") == pytest.approx(angle_rad, abs=0.02)

        until(lambda: goes_to(1.5))
        until(lambda: goes_to(-0.5))
        assert first.get_states()["status"] == "ENABLED"
        assert served.motors[0].shaft.q_rad == pytest.approx(-0.5, abs=0.05)
        assert served.motors[1].shaft.q_rad == 0.0
    finally:
        controller.shutdown()
    until(lambda: all(motor.status == 0 for motor in served.motors))


def test_a_full_queue_is_an_error_at_once_and_nothing_waits(served: Served):
    with can.Bus(interface="humanoid", channel=str(served.path)) as bus:
        for motor in served.motors:  # so that nobody is there to acknowledge
            served.between_steps(lambda node=motor._node: served.wire.nodes.remove(node))
        with pytest.raises(can.CanOperationError) as caught:
            for _ in range(1000):
                bus.send(can.Message(arbitration_id=1, data=bytes(8), is_extended_id=False))
    assert caught.value.error_code == 105


def test_a_program_is_told_when_its_controller_goes_off_the_bus(served: Served):
    with can.Bus(interface="humanoid", channel=str(served.path)) as bus:
        until(lambda: len(served.wire.nodes) == 3)
        served.wire.nodes[2].garbles = 1000
        bus.send(can.Message(arbitration_id=1, data=bytes(8), is_extended_id=False))
        message = bus.recv(PATIENCE_S)
    assert message is not None
    assert message.is_error_frame
    assert message.arbitration_id & 0x40


def test_nobody_there_is_an_error_with_the_path(tmp_path: Path):
    with pytest.raises(can.CanInitializationError, match="nowhere"):
        can.Bus(interface="humanoid", channel=str(tmp_path / "nowhere"))


def test_junk_on_the_socket_is_passed_over(served: Served):
    with can.Bus(interface="humanoid", channel=str(served.path)) as bus:
        for junk in (b"x", b"\xff" * 16, bytes(15), bytes(4) + b"\xff" + bytes(11)):
            bus.socket.send(junk)
        bus.send(can.Message(arbitration_id=1, data=b"\xff" * 7 + b"\xfc", is_extended_id=False))
        message = bus.recv(PATIENCE_S)
    assert message is not None
    assert (message.arbitration_id, message.data[0]) == (0x11, 0x11)
