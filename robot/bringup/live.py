"""The `live` runtime: every part in its own process on the wall clock."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Protocol, Self

import msgspec

from robot.bringup import private_folder
from robot.bringup.body_clock import BodyClock
from robot.bringup.mailbox import RUN_FILE, Handle
from robot.bringup.private_folder import PrivateFolder
from robot.bringup.processes import PROCESSES, Process
from robot.bringup.supervisor import Supervisor
from robot.bus import topics
from robot.bus.lifeline import Turn, ask_for_turn
from robot.bus.run import Run
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import Clock, Waker, WallClock
from robot.closing import Closing
from robot.drivers import registry
from robot.errors import BusError, ConfigError, ProcessError
from robot.failures import Failure, failure
from robot.files.ordinary_files import write_ordinary
from robot.link import BusLink
from robot.messages import LoopTiming
from robot.model import description
from robot.reality.contract import World
from robot.reality.faults import FAULT, Fault, Kill

START_S = 20.0
POLL_S = 0.005
MAX_LAG_S = 0.25


class Crew(Protocol):
    """The robot's processes, looked after by this process or by the one above it."""

    @property
    def restarted(self) -> Sequence[str]:
        """What was started again, in order, a sentence each."""
        ...

    def check(self) -> Failure | None:
        """The first death that cannot be mended; None while all is well."""
        ...

    def pid(self, name: str) -> int:
        """Process id of one of them."""
        ...

    def close(self) -> None:
        """Stop them, or leave that to the process above. Idempotent."""
        ...


class LiveRuntime(Closing):
    """A robot in a simulated world, on the wall clock; a context manager.

    It starts the processes itself; with a `handle` it has the process above start them, or attaches
    to those that run there already (`robot.bringup.launcher`).

    Attributes (`run`, `clock` and `link` from entering on):
        run: what the processes were told.
        clock: the body's time (simulated seconds).
        link: the executive's handle on the body.
        timing: how well the loops kept their time: the newest report of each, by process.
    """

    def __init__(
        self,
        world: World,
        robot: str = "juno",
        *,
        folder: Path,
        seed: int = 0,
        wall: Clock | None = None,
        simulated: bool = True,
        pictures: bool = False,
        handle: Handle | None = None,
        motors: str = "",
        owned: bool | None = None,
        stop_input: Path | None = None,
        processes: tuple[Process, ...] = PROCESSES,
        lidar_map: Path | None = None,
    ) -> None:
        """Check everything that can be checked before a process starts.

        Args:
            world: where it is; the plant's process reads it again, by its name.
            robot: name or path of a robot description.
            folder: of this run; takes `logs/` and `timing.json`.
            seed: of the plant's noise.
            wall: the wall clock; another one in tests.
            simulated: whether reality is: without, no plant is started.
            pictures: whether what the robot's camera sees is rendered, in a process of its own.
            handle: on the process above, where that one looks after the processes.
            motors: driver of the motors in place of the one that the description names.
            owned: whether a process of its own commands them; None: as the description says, and
                where that says nothing, as is usual for its driver (`registry.is_owned`).
            stop_input: a file that emulates the contact of its emergency stop.
            processes: the table; not looked at with a `handle`.
            lidar_map: the map that it finds itself in, where its lidar tells it where it is.

        Raises:
            ConfigError: if the robot or one of its drivers cannot be used.
        """
        body = description.load(robot).driven_by(motors)
        registry.check(body)
        self.timing: dict[str, LoopTiming] = {}
        self._plan = Run(
            folder=str(folder),
            sockets="",
            robot=robot,
            world=world.name,
            seed=seed,
            variation_seed=world.vary_seed,
            reality=world.profile,
            simulated=simulated,
            pictures=pictures or world.eyes == "camera",
            motors=motors,
            stop_input="" if stop_input is None else str(stop_input),
            owned=registry.is_owned(body) if owned is None else owned,
            eyes=world.eyes,
            localisation=world.localisation,
            lidar_map="" if lidar_map is None else str(lidar_map),
        )
        self._handle, self._processes = handle, processes
        self._crew: Crew | None = None
        self._bus: ZenohBus | None = None
        self._private: PrivateFolder | None = None
        self._wall = wall or WallClock()
        self._waker = Waker()
        self._folder = folder
        self._failure: Failure | None = None
        self._due_s = 0.0

    def __enter__(self) -> Self:
        """Start the processes and wait for body, map and world model; see `failure` afterwards.

        Raises:
            BusError, ProcessError: if bus or processes cannot be started; nothing is left then.
        """
        try:
            self._start()
            ask_for_turn(Turn.EXECUTIVE)  # after the others are started, which inherit it
            self._wait_for_body()
        except BaseException:
            self.close()
            raise
        return self

    def _start(self) -> None:
        """Get hold of the processes and of the bus."""
        if self._handle is not None:
            private = self._handle.folder
            self.run = msgspec.structs.replace(self._plan, sockets=str(private))
            self._handle.start(self.run)
            self._join(private)
            self._crew = self._handle
            return
        self._private = private_folder.create()
        private = self._private.path
        self.run = msgspec.structs.replace(self._plan, sockets=str(private))
        self.run.save(private / RUN_FILE)
        self._join(private)
        logs = self._folder / "logs"
        supervisor = Supervisor(
            private / RUN_FILE,
            logs=logs,
            clock=self._wall,
            processes=self._processes,
            simulated=self.run.simulated,
            pictures=self.run.pictures,
            owned=self.run.owned,
        )
        self._crew = supervisor.__enter__()

    def _join(self, private: Path) -> None:
        """Open the bus."""
        bus = self._bus = ZenohBus("executive", private)
        self.clock = BodyClock(bus, self._wall)
        self.link = BusLink(bus, self.clock)
        self._timings = [
            bus.subscribe(topic) for topic in (topics.CONTROLLER_TIMING, topics.PLANT_TIMING)
        ]

    @property
    def supervisor(self) -> Crew:
        """The processes. Raises ProcessError before they are started."""
        if self._crew is None:
            raise ProcessError("the robot's processes were not started")
        return self._crew

    @property
    def restarted(self) -> Sequence[str]:
        """Processes that were started again, in order, a sentence each."""
        return self.supervisor.restarted

    def failure(self) -> Failure | None:
        """Why the run cannot go on, None while it can."""
        if self._failure is None:
            self._failure = self.supervisor.check()
        return self._failure

    def advance(self, duration_s: float) -> None:
        """Let `duration_s` of wall time pass since the last call returned; late calls catch up.

        `wake` cuts it short; the next call then returns when this one would have.
        """
        now_s = self._wall.now_s()
        due_s = max(self._due_s + duration_s, now_s - MAX_LAG_S)
        while self.failure() is None and (now_s := self._wall.now_s()) < due_s:
            if self._waker.wait(min(due_s - now_s, duration_s)):
                break
        else:
            self._due_s = due_s
        self._read_timing()

    def wake(self) -> None:
        """Let `advance` return at once; from any thread, and from a signal handler."""
        self._waker.wake()

    def inject(self, fault: Fault) -> None:
        """Make a fault happen now, in simulation only.

        Names that the plant does not know are refused by the plant, later and silently here.

        Raises:
            ConfigError: if there is no simulation.
        """
        if not self.run.simulated:
            raise ConfigError("faults are injected in simulation only")
        if isinstance(fault, Kill):
            os.kill(self.supervisor.pid(fault.process), signal.SIGKILL)
        else:
            self._opened().publish(FAULT, fault)

    def close(self) -> None:
        """Controller first (it damps the motors), then the rest; write `timing.json`."""
        ask_for_turn(Turn.OTHERS)
        if self._crew is not None:
            self._crew.close()
        if self._bus is not None:
            self._read_timing()
            self._bus.close()
        if self._private is not None:
            private_folder.remove(self._private)
            self._private = None
        if self.timing:
            with suppress(OSError):  # the last words told it; a full disk is no mistake of ours
                self._folder.mkdir(parents=True, exist_ok=True)
                write_ordinary(self._folder / "timing.json", msgspec.json.encode(self.timing))

    def _wait_for_body(self) -> None:
        until_s = self._wall.now_s() + START_S
        link = self.link
        while link.body() is None or link.map() is None or link.world() is None:
            if self.failure() is not None:
                break
            if self._wall.now_s() > until_s:
                self._failure = self._not_up()
                break
            self._wall.sleep_until(self._wall.now_s() + POLL_S)
        self._due_s = self._wall.now_s()

    def _not_up(self) -> Failure:
        """Why it has not come up in time."""
        link, lidar = self.link, self.run.localisation == "lidar"
        if lidar and link.body() is not None and link.map() is not None:
            return failure(
                "localisation_lost",
                f"for {START_S:.0f} s it has not found in its map where it is",
                suggestion="begin elsewhere, or with --localisation oracle",
            )
        return failure(
            "controller_lost",
            f"the robot did not come up within {START_S:.0f} s",
            suggestion=f"see {self._folder / 'logs'}",
        )

    def _opened(self) -> ZenohBus:
        if self._bus is None:
            raise BusError("the bus is not open")
        return self._bus

    def _read_timing(self) -> None:
        for reader in self._timings:
            if (timing := reader.latest) is not None:
                self.timing[timing.process] = timing
