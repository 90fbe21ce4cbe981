"""One process that plans, and the thread that starts it, hears it, and sees it end.

Starting a process takes a tenth of a second on a busy machine, burying one that was killed up to
seconds, and an answer that was begun to be sent is waited for until it is whole. None of that is
for the thread of the tick.
"""

from __future__ import annotations

import multiprocessing
import os
import queue
import signal
import threading
from contextlib import suppress
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess
from typing import NamedTuple

from robot.bus.lifeline import Turn, ask_for_turn, tie_to_parent
from robot.model.description import RobotDescription
from robot.planning.requests import PlanRequest, PlanResult

BURY_S = 2.0
"""How long leaving waits for a process that was killed."""


class Ready(NamedTuple):
    """It can be sent requests."""


class Answered(NamedTuple):
    """It has answered a request."""

    ticket: int
    answer: PlanResult


class Dead(NamedTuple):
    """It is gone, or did not start; the last thing that is heard of it."""


class WorkerProcess:
    """A process from its start to its end; every method returns at once."""

    def __init__(self, description: RobotDescription) -> None:
        """Begin to start it."""
        self._description = description
        self._heard: queue.SimpleQueue[Ready | Answered | Dead] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._unwanted = False
        self._process: SpawnProcess | None = None
        self._pipe: Connection | None = None
        # the kernel kills the process when the thread that started it ends, so that one stays
        self._thread = threading.Thread(target=self._live, name="planner's process", daemon=True)
        self._thread.start()

    def heard(self) -> Ready | Answered | Dead | None:
        """The next thing that it said, None if there is nothing new."""
        try:
            return self._heard.get_nowait()
        except queue.Empty:
            return None

    def send(self, ticket: int, request: PlanRequest) -> None:
        """Have a request answered, once it is ready and has nothing else to do."""
        assert self._pipe is not None
        with suppress(OSError):  # it has died, which is about to be heard
            self._pipe.send((ticket, request))

    def kill(self) -> None:
        """End it, whatever it does."""
        with self._lock:
            self._unwanted = True
            if self._process is not None:
                self._process.kill()

    def wait(self) -> None:
        """Wait until it is gone, after `kill`."""
        self._thread.join(BURY_S)

    def _live(self) -> None:
        try:
            process, pipe = self._start()
            with suppress(EOFError, OSError):
                while True:
                    message = pipe.recv()
                    self._heard.put(Ready() if message is None else Answered(*message))
        finally:
            self._heard.put(Dead())
        process.kill()
        process.join()
        pipe.close()

    def _start(self) -> tuple[SpawnProcess, Connection]:
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        process = context.Process(
            target=_work, args=(self._description, theirs), name="planner", daemon=True
        )
        # Ctrl-C is for the one who plans, not for the worker: it inherits the blocked signal. The
        # tracker comes first, because starting it unblocks the signal.
        resource_tracker.ensure_running()
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        process.start()
        theirs.close()
        with self._lock:
            self._process, self._pipe = process, ours
            if self._unwanted:
                process.kill()
        return process, ours


def _work(description: RobotDescription, pipe: Connection) -> None:
    """The worker: answers requests until the pipe closes."""
    from robot.planning.solve import Solver  # loads OMPL and MuJoCo, wanted only in the worker

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    tie_to_parent((parent.pid if parent is not None else None) or os.getppid())
    ask_for_turn(Turn.PLANNING)
    solver = Solver(description)
    solver.warm_up()  # before it is ready: a request's time is counted from when it is sent
    try:
        pipe.send(None)
        while True:
            ticket, request = pipe.recv()
            pipe.send((ticket, solver.solve(request)))
    except (EOFError, OSError):
        return
