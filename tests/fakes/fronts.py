"""An executive for the launcher's tests, whose one front end does as its options say.

It appends what happens to `folder/told`, a line each, and asks for a robot of stub processes.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

from executive.main import main
from robot.bringup.mailbox import Handle
from robot.bus.run import Run


def front(handle: Handle, options: dict) -> int:
    folder = Path(options["folder"])

    def tell(text: str) -> None:
        with (folder / "told").open("a") as file:
            file.write(text + "\n")

    if options.get("deaf_at_first") and handle.deaths:
        tell("deaf")
        while not (folder / "hear").exists():
            time.sleep(0.01)
    if handle.hear():
        tell("told to stop")
    heard = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: heard.append(number))
    if options.get("robot", True):
        run = Run(folder=str(folder), sockets=str(handle.folder), robot="juno", world="empty")
        handle.start(run)
        while "plant" not in handle._read().pids:
            time.sleep(0.01)
    tell(f"up {os.getpid()} {handle.deaths}")
    until_s = time.monotonic() + 60.0
    while time.monotonic() < until_s:
        if heard:
            tell(f"heard {[int(number) for number in heard]}")
            if not options.get("deaf"):
                return 1
            heard.clear()
        if (failure := handle.check()) is not None:
            tell(f"lost {failure.code}")
            return 3
        if handle.deaths >= options.get("dies", 0):
            if options.get("ends", True):
                return options.get("status", 0)
        elif options.get("how") == "exception":
            raise RuntimeError("a mistake on purpose")
        else:
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.01)
    return 9


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:], load=lambda _: front))
