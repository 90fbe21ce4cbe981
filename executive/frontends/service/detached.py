"""`humanoid up --detach`: the same in a session of its own, which outlives the terminal.

The options come on standard input, as JSON; once the name is claimed, all output goes into a file
beside the socket.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import msgspec

import robot
from executive.frontends import streams
from executive.frontends.exit import ended_by
from executive.frontends.output import Screen, Waiting, say, tell_of_mistakes
from executive.frontends.service import messages as m
from executive.frontends.service import place as places
from executive.frontends.service.client import Connection
from executive.frontends.service.options import Up
from executive.frontends.service.readiness import PATIENCE_S
from executive.runs import run_folder
from robot.errors import RobotError
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import read_ordinary

MODULE = "executive.frontends.service.detached"
LOOK_S = 0.05
MAX_LOG_BYTES = 1_000_000


def up(options: Up) -> int:
    """Start a robot in a session of its own, and wait until it stands; returns the exit status.

    Ctrl-C meanwhile brings it down again.

    Raises:
        ConfigError: if nothing can be kept where it would be.
    """
    run_folder.check_writable(options.run_dir or run_folder.place_for_new()[0])
    process = subprocess.Popen(
        [sys.executable, "-P", "-m", MODULE, options.name],
        stdin=subprocess.PIPE,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": str(Path(robot.__file__).parent.parent)},
    )
    assert process.stdin is not None
    with suppress(OSError), process.stdin as told:
        told.write(msgspec.json.encode(msgspec.to_builtins(options, enc_hook=str)))
    try:
        with Screen(err=True).status("starting the robot"):
            place = _until_listening(options.name, process)
            why_not = "" if place is None else _until_ready(place, process)
    except KeyboardInterrupt:
        process.send_signal(signal.SIGTERM)
        process.wait()
        raise
    if place is None or process.poll() is not None:
        _tell_output(options.name)
        return process.returncode or ExitStatus.BROKEN
    running = places.running(place)
    about = f"{options.robot} in {options.world}, pid {process.pid}"
    if why_not:
        say(f"{options.name} is starting: {about}. It takes no orders yet: {why_not}.")
    else:
        say(f"{options.name} is up: {about}.")
    if running is not None:
        say(f"  {running.run}")
    say('  humanoid say "...", status, stop, attach, logs, down')
    return ExitStatus.DONE


def _until_listening(name: str, process: subprocess.Popen[bytes]) -> places.Place | None:
    """The place of a process, once it listens; None if it ends before."""
    waiting = Waiting("starting the robot")
    while process.poll() is None:
        waiting.look()
        for place in places.places_up():
            running = places.running(place) if place.name == name else None
            if running is not None and running.pid == process.pid:
                return place
        time.sleep(LOOK_S)
    return None


def _until_ready(place: places.Place, process: subprocess.Popen[bytes]) -> str:
    """Wait until a robot that listens takes orders; why it does not, if that takes too long."""
    waiting, until_s = Waiting("starting the robot"), time.monotonic() + PATIENCE_S
    why = "it does not answer"
    while process.poll() is None and time.monotonic() < until_s:
        waiting.look()
        with suppress(RobotError), Connection(place) as connection:
            standing = connection.ask(m.Status(), lambda _: None).standing
            if standing is not None and standing.ready:
                return ""
            if standing is not None:
                why = standing.health or "it does not stand yet"
            if standing is not None and standing.mode == "fallen":
                return "it lies on the floor"
        time.sleep(LOOK_S)
    return why


def _tell_output(name: str) -> None:
    """What it said before it ended."""
    for base in places.bases():
        with suppress(OSError):
            data = read_ordinary(base / name / places.LOG, limit=MAX_LOG_BYTES)
            say(data.decode(errors="replace").rstrip(), err=True)
            return


def main() -> None:
    """The process in a session of its own."""
    from executive.frontends.service.main import up as run

    os.environ["PYTHONSAFEPATH"] = "1"
    streams.steady()
    tell_of_mistakes()
    try:
        options = msgspec.convert(
            msgspec.json.decode(sys.stdin.buffer.read()),
            Up,
            dec_hook=lambda kind, value: kind(value),
        )
        sys.exit(run(options))
    except (Exception, KeyboardInterrupt) as error:
        sys.exit(ended_by(error, as_json=False))


if __name__ == "__main__":
    main()
