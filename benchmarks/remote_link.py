"""`python -m benchmarks.remote_link`: orders and stops from afar, over a wire that loses.

`humanoid remote open` and `humanoid remote join` run in two network namespaces (`lossy_wire`), the
robot is one that only notes what it is told. For each kind of wire: how often it stands although
nobody said so and the wire was whole, how long a stop takes, and how soon after a cut it stands.
"""

from __future__ import annotations

import json
import math
import queue
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, NoReturn

import numpy as np
import typer

from benchmarks.lossy_wire import ADDRESSES, Weather, Wire
from benchmarks.markdown import table
from executive.frontends.service import messages as m
from executive.frontends.service.client import Connection, press
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed, places_up
from executive.frontends.since_boot import now_s
from robot.errors import RobotError
from tests.fakes.steered import Log, Told

WEATHERS = {
    "a cable": Weather(),
    "Wi-Fi, good": Weather(delay_ms=3.0, jitter_ms=10.0, loss=0.005),
    "Wi-Fi, crowded": Weather(delay_ms=5.0, jitter_ms=40.0, loss=0.03, burst=2.0),
    "across a continent": Weather(delay_ms=40.0, jitter_ms=10.0, loss=0.005),
    "a mobile phone": Weather(delay_ms=50.0, jitter_ms=60.0, loss=0.02, burst=3.0),
    "bad": Weather(delay_ms=80.0, jitter_ms=80.0, loss=0.08, burst=3.0),
}
ROBOT, FAR = "robot", "far"
GIVE_UP_S = 60.0
SETTLE_S = 3.0
"""After a cut TCP's retransmissions are up to a second apart; the relay joins anew after one."""


class Ends:
    """A robot behind a gate at one end of a wire, somebody who joined it at the other."""

    def __init__(self, wire: Wire, folder: Path, stack: ExitStack) -> None:
        """Start them all."""
        self._wire, self._stack = wire, stack
        self._places = [self._place(folder / str(end)) for end in (0, 1)]
        self.told, _ = self._started(0, "robot")
        command = [sys.executable, "-m", "executive", "remote"]
        file = str(folder / "anna.invitation")
        invited = [*command, "invite", "anna", "--role", "command", "--at", ADDRESSES[0]]
        assert wire.start(0, [*invited, "--out", file], **self._places[0]).wait() == 0
        opened = [*command, "open", "--name", ROBOT, "--listen", ADDRESSES[0]]
        heard, _ = self._follow(wire.start(0, opened, **self._places[0]))
        heard.get(timeout=GIVE_UP_S)
        joined = [*command, "join", file, "--name", FAR]
        heard, _ = self._follow(wire.start(1, joined, **self._places[1]))
        heard.get(timeout=GIVE_UP_S)
        self.answers, self._guest = self._started(1, "guest")

    @staticmethod
    def _place(folder: Path) -> dict[str, str]:
        folder.mkdir(mode=0o700)
        names = ("XDG_RUNTIME_DIR", "XDG_STATE_HOME", "XDG_CONFIG_HOME")
        return dict.fromkeys(names, str(folder))

    def _started(self, end: int, role: str) -> tuple[queue.Queue[str], subprocess.Popen[str]]:
        argv = [sys.executable, "-m", "benchmarks.remote_link", "--as", role]
        lines, process = self._follow(self._wire.start(end, argv, **self._places[end]))
        lines.get(timeout=GIVE_UP_S)
        return lines, process

    def _follow(
        self, process: subprocess.Popen[str]
    ) -> tuple[queue.Queue[str], subprocess.Popen[str]]:
        """What a process says, line by line; it is ended with all others."""
        self._stack.callback(process.wait)
        self._stack.callback(process.send_signal, signal.SIGTERM)
        lines = queue.Queue[str]()

        def read() -> None:
            for line in process.stdout or ():
                lines.put(line)

        threading.Thread(target=read, daemon=True).start()
        return lines, process

    def say(self, line: str) -> float:
        """What somebody far away does; when it began, in seconds since boot; NaN: it failed."""
        assert self._guest.stdin is not None
        self._guest.stdin.write(f"{line}\n")
        self._guest.stdin.flush()
        return json.loads(self.answers.get(timeout=3 * GIVE_UP_S))

    def walk(self) -> None:
        """See that it does something that was said from afar."""
        until_s = now_s() + GIVE_UP_S
        while np.isnan(self.say("walk")):
            if now_s() > until_s:
                raise RobotError("the link does not come back")
            time.sleep(0.1)
        self.stops()

    def stops(self, wait_s: float = 0.0) -> list[float]:
        """When the robot was told to stop, since this was asked last; waits for one so long."""
        found = list[str]()
        try:
            found.append(self.told.get(timeout=wait_s) if wait_s else self.told.get_nowait())
            while True:
                found.append(self.told.get_nowait())
        except queue.Empty:
            return [json.loads(line) for line in found]


def measured(
    ends: Ends, wire: Wire, *, watch_s: float, times: int, rng: random.Random
) -> Sequence[str]:
    """One row of the table, of the weather that there is."""
    ends.walk()
    false_stops, end_s = 0, now_s() + watch_s
    while (left_s := end_s - now_s()) > 0:
        if ends.stops(left_s):
            false_stops += 1
            ends.walk()
    stops_ms, cuts_ms = list[float](), list[float]()
    for _ in range(times):
        ends.walk()
        time.sleep(rng.uniform(0.1, 0.4))
        ends.stops()
        began_s = ends.say("stop")
        stops_ms.append(1e3 * (_first(ends, began_s) - began_s))
    for _ in range(times):
        ends.walk()
        time.sleep(rng.uniform(0.1, 0.4))
        ends.stops()
        began_s, wire.is_cut = now_s(), True
        cuts_ms.append(1e3 * (_first(ends, began_s) - began_s))
        wire.is_cut = False
        time.sleep(SETTLE_S)
    cuts_ms = [one for one in cuts_ms if math.isfinite(one)]  # else it stood already, unasked
    return (f"{60.0 * false_stops / watch_s:.1f}", _spread(stops_ms), _spread(cuts_ms))


def _first(ends: Ends, began_s: float) -> float:
    """When the robot was told to stop after something; infinity: it was not."""
    later = [at_s for at_s in ends.stops(GIVE_UP_S) if at_s >= began_s]
    return later[0] if later else float("inf")


def _spread(values_ms: Sequence[float]) -> str:
    return f"{np.median(values_ms):.0f} / {max(values_ms):.0f}"


# --- what runs at the ends ---


class Noted(Told):
    """A shell that prints when it was told to stop, in seconds since boot."""

    def stop(self, why: str) -> None:
        """Told by a person's button."""
        super().stop(why)  # pyright: ignore[reportUnknownMemberType]
        self._over()

    def stop_unsaid(self, why: str) -> None:
        """Told by something else: a link that is lost."""
        super().stop_unsaid(why)  # pyright: ignore[reportUnknownMemberType]
        self._over()

    def _over(self) -> None:
        for number in tuple(self.robot.jobs):
            self.end(number, "cancelled")  # pyright: ignore[reportUnknownMemberType]
        print(now_s(), flush=True)


def _be_robot() -> None:
    running = Running(pid=0, run="", private="", world="empty", robot="juno", runtime="live")
    with claimed(ROBOT) as place, Counter(Noted(), place=place, running=running, log=Log()):  # type: ignore[arg-type]
        print("up", flush=True)
        signal.pause()


def _be_guest() -> NoReturn:
    while not (place := next((place for place in places_up() if place.name == FAR), None)):
        time.sleep(0.1)
    print("up", flush=True)
    for line in sys.stdin:
        began_s = now_s()
        try:
            if line.strip() == "stop":
                press(place, "stop", lambda _: None)
            else:
                with Connection(place) as connection:
                    connection.ask(m.Say(text="walk"), lambda _told: None, wait_s=GIVE_UP_S)
        except RobotError:
            began_s = float("nan")
        print(json.dumps(began_s), flush=True)
    sys.exit(0)


def main(
    watch_s: Annotated[float, typer.Option(help="how long each wire is watched")] = 60.0,
    times: Annotated[int, typer.Option(help="how many stops and how many cuts")] = 20,
    only: Annotated[str, typer.Option(help="kinds of wire whose name contains this")] = "",
    as_: Annotated[str, typer.Option("--as", hidden=True)] = "",
) -> None:
    """Measure, and print a table."""
    if as_:
        _be_robot() if as_ == "robot" else _be_guest()
        return
    rng, rows = random.Random(0), list[Sequence[str]]()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        wire = stack.enter_context(Wire())
        ends = Ends(wire, folder, stack)
        for name, weather in WEATHERS.items():
            if only in name:
                wire.weather = weather
                row = measured(ends, wire, watch_s=watch_s, times=times, rng=rng)
                rows.append((name, *row))
                print(" | ".join(rows[-1]), flush=True)
    head = ("wire", "stands unasked / min", "stop [ms] p50 / max", "cut to stop [ms] p50 / max")
    print(table(head, rows))


if __name__ == "__main__":
    typer.run(main)
