"""A robot as a service: the prompt's conversation without a terminal, for those of other terminals.

The name is held by the process that was started as `humanoid up`, which outlives executives; the
socket is the executive's.
"""

from __future__ import annotations

import os
import socket
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from executive.frontends import speaking
from executive.frontends.launching import FrontEnd, from_plain_options, here, launch
from executive.frontends.options import Prompt
from executive.frontends.output import say
from executive.frontends.printer import Printer
from executive.frontends.prompt.cli import Begun, Telling, conversation
from executive.frontends.prompt.shell import Shell
from executive.frontends.service import place as places
from executive.frontends.service.counter import Counter
from executive.frontends.service.options import Ros2, Up
from executive.frontends.service.place import Place, Running
from executive.frontends.service.readiness import Announcement
from executive.frontends.service.ros2_beside import bridged, check
from executive.frontends.service.ros2_plan import Plan, namespace_of
from executive.frontends.service.telling import Log
from robot.bringup.mailbox import Handle
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import open_to_append

POLL_S = 0.1
REST_S = 15.0
"""How long it may take to come to a stand; whoever closes the robot waits longer."""


@dataclass(frozen=True, kw_only=True)
class Served(Begun, Ros2):
    """What a service's executive is told: the options, and where it can be reached."""

    name: str
    place: Path
    pid: int


def up(options: Up) -> int:
    """Run a robot until somebody wants it down; returns the exit status.

    Raises:
        RobotError: the name is taken, a file is wrong (ConfigError), or a part does not start.
    """
    if options.ros2:
        check(options.ros2_router, fast=options.fast)
    with places.claimed(options.name) as place:
        if options.detach:
            _write_into(place.folder / places.LOG)
        names = (*Prompt.__dataclass_fields__, *Ros2.__dataclass_fields__)
        fields = {name: getattr(options, name) for name in names}
        served = Served(**fields, name=options.name, place=place.folder, pid=os.getpid())
        if options.fast:
            return here(in_executive, served)
        return launch(FrontEnd.SERVICE, served)


def _write_into(path: Path) -> None:
    """Let all that this process and those that it starts write go into a file."""
    log = open_to_append(path)
    for fd in (1, 2):
        os.dup2(log, fd)
    os.close(log)


def serve(options: Served, handle: Handle | None = None) -> int:
    """Take requests until somebody wants the robot to be down; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    place = Place(options.name, options.place)
    aloud = speaking.able(wanted=options.aloud, model=options.voice_model)
    printer = Printer(say)
    try:
        with (
            speaking.opened(wanted=aloud, model=options.voice_model) as speech,
            conversation(options, options.name, handle=handle, speech=speech, out=printer) as shell,
        ):
            return _attend(shell, place, options, handle)
    finally:
        printer.close()


in_executive = from_plain_options(Served, serve)


def _attend(shell: Shell, place: Place, options: Served, handle: Handle | None) -> int:
    running = Running(
        pid=options.pid,
        run=str(shell.folder.absolute()),
        private=str(handle.folder) if handle is not None else "",
        world=options.world,
        robot=options.robot,
        runtime="live" if handle is not None else "fast",
    )
    interrupts = shell.robot.interrupts
    before = interrupts.pressed
    log = Log(shell.folder)
    try:
        with (
            Counter(shell, place=place, running=running, log=log) as counter,
            bridged(_plan(options, place, handle, shell), logs=shell.folder, out=shell.out),
        ):
            shell.robot.session.journal.listen(Telling(counter.tell))
            announcement = Announcement(
                options.name, greeting(options), fast=handle is None, view=lambda: shell.robot.view,
                now_s=time.monotonic, out=shell.out, ready=lambda: tell_manager("READY=1"),
            )  # fmt: skip
            while not counter.left.wait(POLL_S):
                announcement.look()
                if shell.gone or interrupts.leaving or interrupts.pressed != before:
                    break
            tell_manager("STOPPING=1")
            if shell.gone:
                shell.out(shell.gone)
                return ExitStatus.BROKEN
            _leave(shell)
    finally:
        log.close()
    return ExitStatus.DONE


def _plan(options: Served, place: Place, handle: Handle | None, shell: Shell) -> Plan | None:
    """What the bridge to ROS 2 is told, if there is to be one."""
    if not options.ros2 or handle is None:
        return None
    return Plan(
        router=options.ros2_router,
        domain=options.ros2_domain,
        namespace="" if options.name == places.DEFAULT_NAME else namespace_of(options.name),
        sockets=str(handle.folder),
        name=place.name,
        place=str(place.folder),
        robot=options.robot,
        pictures=options.camera or shell.robot.where.world.eyes == "camera",
    )


def _leave(shell: Shell) -> None:
    """Bring the robot to a stand, while everybody who waits for it is still there."""
    shell.out("The robot comes to a stand.")
    shell.leave()
    until_s = time.monotonic() + REST_S
    while shell.robot.busy and shell.robot.lost is None and time.monotonic() < until_s:
        time.sleep(POLL_S / 5)
    shell.speech.hush()


def greeting(options: Served) -> str:
    """What a robot says that is up."""
    named = "" if options.name == places.DEFAULT_NAME else f" --name {options.name}"
    kind = "fast" if options.fast else "live"
    return (
        f"{options.name} is up: {options.robot} in {options.world}, {kind}. From any terminal: "
        f'humanoid say{named} "...", humanoid stop, humanoid attach{named}, humanoid down{named}'
    )


def tell_manager(state: str) -> None:
    """Tell a service manager how it stands, where there is one: sd_notify(3)."""
    path = os.environ.get("NOTIFY_SOCKET", "")
    if not path.startswith(("/", "@")):
        return
    with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
        manager.sendto(state.encode(), path.replace("@", "\0", 1) if path[0] == "@" else path)
