"""Plant, controller and perception as real processes: they work, die, and leave nothing behind."""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import msgspec
import numpy as np
import pytest

from robot.bringup.live import LiveRuntime
from robot.bringup.processes import CONTROLLER
from robot.bus import topics
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.drivers.motors.simulated import SimulatedMotors
from robot.drivers.simulation.shared_plant import SharedPlant
from robot.errors import ConfigError
from robot.messages import BodyState, LoopTiming, WalkTo
from robot.model import description
from sim.simulation import Simulation
from tests.fakes.waiting import HANG_S, eventually

pytestmark = pytest.mark.live

NAMES = ("plant", "controller", "perception")


def gone(pid: int) -> bool:
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return True
    return stat.rpartition(")")[2].split()[0] == "Z"


def walk(runtime: LiveRuntime, until: Callable[[BodyState], bool]) -> BodyState:
    """Send it 1 m ahead; how it is once that holds, however long a busy machine takes for it."""
    link = runtime.link
    command = WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=1.0, y_m=0.0, yaw_rad=0.0)
    link.send(command)
    assert eventually(lambda: (runtime.advance(0.05), until(link.body()))[1])
    return link.body()


def walks(body: BodyState) -> bool:
    return body.mode == "walk"


def has_failed(body: BodyState) -> bool:
    return "legs" in body.activities and body.activities["legs"].status == "failed"


def kill(runtime: LiveRuntime, name: str) -> None:
    """Kill -9 a process, and return when it is dead, before anybody has looked."""
    pid = runtime.supervisor.pid(name)
    os.kill(pid, signal.SIGKILL)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)


@pytest.fixture
def live(tmp_path: Path):
    with LiveRuntime(Simulation().world("kitchen"), folder=tmp_path / "run", seed=1) as runtime:
        assert runtime.failure() is None, runtime.failure()
        pids = {name: runtime.supervisor.pid(name) for name in NAMES}
        yield runtime
        private = Path(runtime.run.sockets)
    assert all(gone(pid) for pid in pids.values())
    assert not private.exists()


def test_it_walks_and_reports_how_well_it_kept_time(live: LiveRuntime):
    walk(live, lambda body: body.X_NB.p[0] > 0.2)
    assert live.failure() is None
    assert live.link.world().fix_age_s < 0.5
    live.close()
    timing = msgspec.json.decode(
        (Path(live.run.folder) / "timing.json").read_bytes(), type=dict[str, LoopTiming]
    )
    assert set(timing) == {"controller", "plant"}
    for report in timing.values():
        assert report.count > 500
        assert 0 <= report.late <= report.count
        assert report.p50_s <= report.p99_s <= report.p999_s <= report.max_s
        assert 0.1 < report.real_time_factor < 1.05


def test_the_spare_holds_the_robot_up_when_the_controller_is_killed(live: LiveRuntime):
    """Standing, as a walk is caught nearly always only."""
    while live.link.now_s() < CONTROLLER.spare_after_s + 4.0:
        live.advance(0.05)
    before = live.link.body()
    kill(live, "controller")
    assert live.failure() is None
    assert live.restarted == ["the controller was killed by SIGKILL; started again"]  # at one look
    live.advance(1.0)
    after = live.link.body()
    assert after.since_s > before.since_s
    assert after.mode == "stand"  # it would damp, and say so, had nobody commanded it for 0.1 s
    assert after.failure is None
    walk(live, walks)


def test_without_a_spare_the_motors_damp_until_the_robot_is_told_to_stand(live: LiveRuntime):
    os.kill(live.supervisor.pid("controller"), signal.SIGKILL)
    robot = description.load("juno")
    plant = SharedPlant(robot, live.run.memory, clock=WallClock())
    with SimulatedMotors(plant) as reader:
        assert eventually(lambda: reader.read().watchdog)
        state = reader.read()
        limits = [motor.torque_limit_nm for motor in robot.motors.values()]
        assert all(abs(tau) <= limit * 1.05 for tau, limit in zip(state.tau, limits, strict=True))
    until_s = time.monotonic() + HANG_S
    while live.link.body().since_s == 0.0 and time.monotonic() < until_s:
        live.advance(0.05)
    body = live.link.body()
    assert body.mode in ("damping", "fallen")
    assert body.failure.code in ("controller_lost", "fallen")
    walk(live, has_failed)
    assert live.failure() is None


def test_a_stopped_controller_damps_says_how_long_and_must_be_armed_again(live: LiveRuntime):
    pid = live.supervisor.pid("controller")
    os.kill(pid, signal.SIGSTOP)
    live.advance(0.5)
    os.kill(pid, signal.SIGCONT)
    until_s = time.monotonic() + HANG_S
    while live.link.body().mode == "stand" and time.monotonic() < until_s:
        live.advance(0.05)
    body = live.link.body()
    assert body.mode in ("damping", "fallen")
    assert "stood still for " in body.failure.cause
    body = walk(live, has_failed)
    assert body.mode in ("damping", "fallen")  # it goes down meanwhile
    assert live.failure() is None


def test_a_killed_plant_is_told_at_the_next_look(live: LiveRuntime):
    walk(live, walks)
    assert live.failure() is None
    kill(live, "plant")
    assert live.failure().code == "plant_lost"


def test_killed_perception_comes_again(live: LiveRuntime):
    before = live.link.world().stamp_s
    kill(live, "perception")
    until_s = time.monotonic() + HANG_S
    while time.monotonic() < until_s:
        live.advance(0.05)
        if live.supervisor.restarted and live.link.world().stamp_s > before + 1.0:
            break
    assert live.failure() is None
    assert live.restarted == ["the perception was killed by SIGKILL; started again"]
    assert live.link.world().stamp_s > before + 1.0
    assert live.link.body().mode == "stand"


def test_a_bad_world_or_robot_is_refused_before_anything_starts(tmp_path: Path):
    for world, robot in (("kitchn", "juno"), ("kitchen", "junno")):
        with pytest.raises(ConfigError, match=r"juno|kitchen"):
            LiveRuntime(Simulation().world(world), robot, folder=tmp_path)
    assert not list(tmp_path.iterdir())


SCRIPT = """
import sys
from pathlib import Path
from robot.bringup.live import LiveRuntime
from sim.simulation import Simulation
with LiveRuntime(Simulation().world("kitchen"), folder=Path(sys.argv[1])) as runtime:
    names = ("plant", "controller", "perception")
    print(*(runtime.supervisor.pid(name) for name in names), runtime.run.sockets, flush=True)
    while True:
        runtime.advance(0.05)
"""


def test_a_killed_executive_leaves_no_process(tmp_path: Path):
    parent = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, str(tmp_path)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert parent.stdout is not None
        *words, sockets = parent.stdout.readline().split()
        pids = [int(word) for word in words]
        assert len(pids) == 3
        assert not any(gone(pid) for pid in pids)
    finally:
        parent.kill()
        parent.wait()
    assert eventually(lambda: all(gone(pid) for pid in pids))
    shutil.rmtree(sockets)  # the one thing that nobody was left to take away


def test_pictures_are_rendered_beside_the_plant(tmp_path: Path):
    world = Simulation().world("kitchen")
    with LiveRuntime(world, folder=tmp_path / "run", seed=1, pictures=True) as runtime:
        assert runtime.failure() is None, runtime.failure()
        with ZenohBus("observer", runtime.run.sockets) as bus:
            pictures = bus.subscribe(topics.RGBD)
            seen = []

            def has_seen() -> bool:
                runtime.advance(0.05)
                seen.extend(pictures.take())
                return len(seen) >= 3

            assert eventually(has_seen)
        assert runtime.failure() is None
        image = seen[-1]
        assert (image.width, image.height) == (320, 240)
        assert image.picture().std() > 10.0
        assert 0.0 < np.median(image.depth()) < 5.0
        assert eventually(lambda: (runtime.advance(0.05), runtime.link.camera().code)[1] == "")
