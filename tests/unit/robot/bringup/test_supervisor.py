"""Whatever happens to children or parent, deaths are told and no process is left."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from robot.bringup.child import describe_exit
from robot.bringup.processes import PROCESSES, STOP_ORDER, Process
from robot.bringup.supervisor import Supervisor, last_line
from robot.clock import WallClock
from robot.failures import CATALOGUE
from tests.fakes.waiting import eventually

STUB = "tests.fakes.stub_process"
THREE = (
    Process("plant", STUB, "simulation", death="plant_lost"),
    Process("controller", STUB, "always", death="controller_lost"),
    Process("perception", STUB, "always", death="localisation_lost", restarts=1),
)


def alive(pid: int) -> bool:
    """Whether a process runs (a zombie does not)."""
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return stat.rpartition(")")[2].split()[0] != "Z"


@pytest.fixture
def supervise(tmp_path: Path) -> Callable[..., Supervisor]:
    def make(
        word: str = "obey", processes: tuple[Process, ...] = THREE, **options: bool
    ) -> Supervisor:
        run_file = tmp_path / "run"
        run_file.write_text(word)
        logs = tmp_path / "logs"
        return Supervisor(run_file, logs=logs, clock=WallClock(), processes=processes, **options)

    return make


def ready(supervisor: Supervisor, tmp_path: Path, *names: str) -> dict[str, int]:
    """Wait until the named children run; their process ids."""
    for name in names:
        log = tmp_path / "logs" / f"{name}.log"
        assert eventually(lambda log=log: last_line(log) == "ready")
    return {name: supervisor.pid(name) for name in names}


ALL = ("plant", "controller", "perception")


def test_children_run_and_are_gone_afterwards(supervise, tmp_path):
    with supervise() as supervisor:
        pids = ready(supervisor, tmp_path, *ALL)
        assert all(alive(pid) for pid in pids.values())
        assert supervisor.check() is None
        written = (tmp_path / "logs" / "plant.pid").read_text()
        assert int(written) == pids["plant"]
    assert not any(alive(pid) for pid in pids.values())
    assert not list((tmp_path / "logs").glob("*.pid"))


def test_a_full_disk_keeps_no_robot_from_starting(supervise, tmp_path):
    (tmp_path / "logs").mkdir()
    (tmp_path / "logs" / "plant.pid").symlink_to("/dev/full")
    with supervise() as supervisor:
        ready(supervisor, tmp_path, *ALL)
        assert supervisor.check() is None


def test_where_reality_is_real_nothing_stands_in_for_it(supervise, tmp_path):
    with supervise(simulated=False) as supervisor:
        assert list(ready(supervisor, tmp_path, *ALL[1:])) == list(supervisor.pids)
        assert supervisor.check() is None
    assert not supervisor.pids


@pytest.mark.parametrize(
    ("name", "code"), [("plant", "plant_lost"), ("controller", "controller_lost")]
)
def test_a_killed_child_is_told_at_once_and_nothing_is_left(supervise, tmp_path, name, code):
    with supervise() as supervisor:
        pids = ready(supervisor, tmp_path, *ALL)
        os.kill(pids[name], signal.SIGKILL)
        os.waitid(os.P_PID, pids[name], os.WEXITED | os.WNOWAIT)  # dead, and nobody has looked yet
        failure = supervisor.check()
        assert failure is not None
        assert failure.code == code
        assert "SIGKILL" in failure.cause
        assert failure.evidence["process"] == name
        assert f"{name}.log" in failure.suggestion
        assert supervisor.check() is failure
    assert not any(alive(pid) for pid in pids.values())


def test_what_may_be_restarted_is_until_it_is_a_crash_loop(supervise, tmp_path):
    with supervise() as supervisor:
        first = ready(supervisor, tmp_path, *ALL)["perception"]
        os.kill(first, signal.SIGKILL)
        told = ["the perception was killed by SIGKILL; started again"]
        assert eventually(lambda: (supervisor.check(), supervisor.restarted)[1] == told)
        second = supervisor.pid("perception")
        assert second != first
        assert supervisor.check() is None
        os.kill(second, signal.SIGKILL)
        assert eventually(supervisor.check)
        assert supervisor.check().code == "localisation_lost"


def test_a_spare_is_loaded_in_time_and_is_the_one_that_goes_on(supervise, tmp_path):
    spared = Process("b", STUB, "always", death="controller_lost", restarts=1, spare_after_s=0.0)
    with supervise(processes=(spared,)) as supervisor:
        first = ready(supervisor, tmp_path, "b")["b"]
        supervisor.check()
        os.kill(first, signal.SIGKILL)
        assert eventually(lambda: (supervisor.check(), supervisor.restarted)[1])
        second = supervisor.pid("b")
        log = tmp_path / "logs" / "b.log"
        assert eventually(lambda: log.read_text().count("ready") == 2)
        assert alive(second)
        assert supervisor.check() is None
        os.kill(second, signal.SIGKILL)
        assert eventually(supervisor.check)
        assert supervisor.check().code == "controller_lost"
        assert log.read_text().count("ready") == 2  # none was loaded that could not be used


def test_a_spare_goes_with_the_rest(supervise, tmp_path):
    spared = Process(
        "b", STUB, "always", death="controller_lost", restarts=1, spare_after_s=0.0, stop_s=0.1
    )
    before = children()
    with supervise("stubborn", (spared,)) as supervisor:
        supervisor.check()
        log = tmp_path / "logs" / "b.log"
        assert eventually(lambda: log.read_text().count("ready") == 2)
        both = children() - before
        assert len(both) == 2
    assert not any(alive(pid) for pid in both)


def children() -> set[int]:
    """Process ids of the children of this process."""
    own = os.getpid()
    return {int(pid) for pid in Path(f"/proc/{own}/task/{own}/children").read_text().split()}


def test_a_crash_says_what_the_process_said_last(supervise):
    with supervise("crash", THREE[:1]) as supervisor:
        assert eventually(supervisor.check)
        failure = supervisor.check()
        assert "ended with status 3" in failure.cause
        assert "meant to crash" in failure.cause


def test_a_child_that_will_not_stop_is_killed(supervise, tmp_path):
    with supervise("stubborn", (replace(THREE[0], stop_s=0.1),)) as supervisor:
        pids = ready(supervisor, tmp_path, "plant")
    assert not alive(pids["plant"])


def test_grandchildren_go_too(supervise, tmp_path):
    with supervise("child", THREE[:1]) as supervisor:
        ready(supervisor, tmp_path, "plant")
        grandchild = int((tmp_path / "run.child").read_text())
        assert alive(grandchild)
    assert eventually(lambda: not alive(grandchild))


def test_closing_twice_is_fine(supervise, tmp_path):
    supervisor = supervise("obey", THREE[:1])
    with supervisor:
        ready(supervisor, tmp_path, "plant")
        supervisor.close()
    supervisor.close()


PARENT = """
import sys, time
from pathlib import Path
from robot.bringup.child import describe_exit
from robot.bringup.processes import Process
from robot.bringup.supervisor import Supervisor
from robot.clock import WallClock
folder = Path(sys.argv[1])
entries = tuple(Process(n, "tests.fakes.stub_process", "always", death="plant_lost") for n in "ab")
with Supervisor(folder / "run", logs=folder / "logs", clock=WallClock(), processes=entries):
    time.sleep(600)
"""


@pytest.mark.parametrize("word", ["obey", "stubborn"])
def test_children_of_a_killed_parent_die_with_it(tmp_path, word):
    (tmp_path / "run").write_text(word)
    parent = subprocess.Popen([sys.executable, "-c", PARENT, str(tmp_path)])
    try:
        logs = [tmp_path / "logs" / f"{name}.log" for name in "ab"]
        assert eventually(lambda: all(last_line(log) == "ready" for log in logs))
        pids = [int(log.with_suffix(".pid").read_text()) for log in logs]
        assert all(alive(pid) for pid in pids)
    finally:
        parent.kill()
        parent.wait()
    assert eventually(lambda: not any(alive(pid) for pid in pids))


def test_a_camera_is_started_where_it_is_wanted_and_ends_no_run_when_it_dies(supervise, tmp_path):
    camera = Process(
        "camera", STUB, "pictures", death="camera_unplugged", restarts=1, is_vital=False
    )
    processes = (*THREE, camera)
    with supervise(processes=processes) as supervisor:
        ready(supervisor, tmp_path, *ALL)
        assert "camera" not in supervisor.pids
    with supervise(processes=processes, pictures=True) as supervisor:
        for times in range(2):
            pids = ready(supervisor, tmp_path, *ALL, "camera")
            os.kill(pids["camera"], signal.SIGKILL)
            assert eventually(lambda pids=pids: not alive(pids["camera"]))
            assert supervisor.check() is None
            assert len(supervisor.restarted) == min(times + 1, 1)


def test_the_table_is_sound():
    names = [entry.name for entry in PROCESSES]
    assert sorted(names) == sorted(STOP_ORDER)
    for entry in PROCESSES:
        assert entry.death in CATALOGUE
        assert entry.restarts or entry.spare_after_s is None


def test_exit_statuses_are_told_in_words():
    assert describe_exit(0) == "ended with status 0"
    assert describe_exit(-9) == "was killed by SIGKILL"
    assert "200" in describe_exit(-200)
    assert last_line(Path("/nonexistent")) == ""
