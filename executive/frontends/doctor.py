"""`humanoid doctor`: what is there and what is missing on this machine, each with its cure."""

from __future__ import annotations

import ctypes.util
import importlib
import importlib.metadata
import os
import shutil
import socket
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Literal

import msgspec

from executive.frontends import keys, namesakes
from executive.frontends.output import say, write_json
from robot.errors import ConfigError, RobotError
from robot.exit_status import ExitStatus

MIN_FREE_MB = 200
ROUTER_S = 0.5
EGL_PACKAGES = "sudo apt install libegl1 libgl1-mesa-dri libopengl0"
LIBRARIES = {
    "mujoco": "mujoco", "daqp": "daqp", "ompl": "ompl", "ruckig": "ruckig",
    "py_trees": "py-trees", "msgspec": "msgspec", "zenoh": "eclipse-zenoh", "numpy": "numpy",
    "scipy": "scipy", "typer": "typer", "rich": "rich",
    "pocketsphinx": "pocketsphinx", "xxhash": "xxhash",
    "can": "python-can", "yaml": "pyyaml", "rapidfuzz": "rapidfuzz", "symspellpy": "symspellpy",
}  # fmt: skip
"""Module to distribution."""

Verdict = Literal["ok", "optional", "missing"]
_MARKS: dict[Verdict, tuple[str, str]] = {
    "ok": ("ok", "green"), "optional": ("--", "yellow"), "missing": ("no", "red"),
}  # fmt: skip


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """One thing looked at. "optional" is missed by some commands only."""

    name: str
    verdict: Verdict
    text: str
    cure: str = ""


def doctor(*, robot: str = "juno", as_json: bool) -> int:
    """Examine the machine; returns the exit status, 2 if something needed is missing."""
    findings = examine(robot=robot)
    missing = any(finding.verdict == "missing" for finding in findings)
    status = ExitStatus.INVALID if missing else ExitStatus.DONE
    if as_json:
        write_json(findings)
        return status
    for finding in findings:
        mark, style = _MARKS[finding.verdict]
        say(f"{mark}  {finding.name:14}  {finding.text}", styled=(mark, style))
        if finding.cure:
            say(f"    cure: {finding.cure}", styled=("    cure:", "dim"))
    cure = "Something that is needed is missing; see its cure above."
    say(cure if missing else "All that is needed is there.")
    return status


def examine(run_folder: Path = Path(), *, robot: str = "juno") -> list[Finding]:
    """Look at everything; never raises."""
    checks: list[Callable[[], Finding]] = [
        _python, _names, _libraries, lambda: _robot(robot), _worlds, _egl, _display, _cores,
        _shared_memory, _microphone, _voice, _model_keys, _ros2,
    ]  # fmt: skip
    return [*(check() for check in checks), _disk(run_folder)]


def _python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    if (3, 11) <= sys.version_info[:2] <= (3, 13):
        return Finding(name="Python", verdict="ok", text=version)
    return Finding(
        name="Python", verdict="missing", text=f"{version}; 3.11 to 3.13 are supported",
        cure="make clean && make PYTHON=python3.12 test",
    )  # fmt: skip


def _names() -> Finding:
    """Whether the names of our packages are ours alone."""
    wrong = [*namesakes.elsewhere(), *namesakes.owners()]
    if wrong:
        return Finding(name="names", verdict="missing", text="; ".join(wrong), cure=namesakes.CURE)
    return Finding(name="names", verdict="ok", text=f"{', '.join(namesakes.NAMES)} are ours alone")


def _libraries() -> Finding:
    missing: list[str] = []
    for module, distribution in LIBRARIES.items():
        try:
            importlib.import_module(module)
        except ImportError:
            missing.append(distribution)
    if missing:
        return Finding(
            name="libraries", verdict="missing", text=f"not there: {', '.join(missing)}",
            cure=f"pip install {' '.join(missing)}",
        )  # fmt: skip
    mujoco = importlib.metadata.version("mujoco")
    return Finding(name="libraries", verdict="ok", text=f"all {len(LIBRARIES)}; mujoco {mujoco}")


def _robot(name: str) -> Finding:
    """Whether a robot can be used: all that it names is there, and what it says fits its body."""
    from robot.model.description import load
    from robot.planning.fit import misfits

    try:
        body = load(name)
        wrong = misfits(body)
    except RobotError as error:
        cure = "install the package again" if name == "juno" else "see docs/robots.md"
        return Finding(name="robot", verdict="missing", text=str(error), cure=cure)
    if wrong:
        cure = "correct the description; see docs/robots.md"
        return Finding(name="robot", verdict="missing", text="; ".join(wrong), cure=cure)
    lacks = [
        part for part, there in (("neck", body.groups["head"]), ("hands", body.hands)) if not there
    ]
    text = f"{body.name}, {len(body.motors)} motors" + "".join(f", no {part}" for part in lacks)
    return Finding(name="robot", verdict="ok", text=text)


def _worlds() -> Finding:
    from executive.frontends.composition_root import REALITY

    try:
        names = REALITY.names()
        for name in names:
            REALITY.world(name)
    except RobotError as error:
        return Finding(
            name="worlds", verdict="missing", text=str(error), cure="install the package again"
        )
    return Finding(name="worlds", verdict="ok", text=", ".join(names))


def _egl() -> Finding:
    if ctypes.util.find_library("EGL") and ctypes.util.find_library("OpenGL"):
        return Finding(name="EGL", verdict="ok", text="pictures can be rendered without a display")
    return Finding(
        name="EGL", verdict="optional", text="not there: pictures are drawn by rays, slower",
        cure=EGL_PACKAGES,
    )  # fmt: skip


def _display() -> Finding:
    display = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY")
    if display:
        return Finding(name="display", verdict="ok", text=display)
    return Finding(
        name="display", verdict="optional", text="none: view can only make snapshots",
        cure="run it on a desktop, or use: humanoid view --snapshot out.png",
    )  # fmt: skip


def _microphone() -> Finding:
    if ctypes.util.find_library("portaudio"):
        return Finding(name="microphone", verdict="ok", text="PortAudio is there")
    return Finding(
        name="microphone", verdict="optional", text="no PortAudio: listen can only take recordings",
        cure="sudo apt install libportaudio2",
    )  # fmt: skip


def _voice() -> Finding:
    programs = [name for name in ("espeak-ng", "piper") if shutil.which(name)]
    if programs:
        return Finding(name="voice", verdict="ok", text=", ".join(programs))
    return Finding(
        name="voice", verdict="optional", text="none: answers are printed only",
        cure="sudo apt install espeak-ng",
    )  # fmt: skip


def _model_keys() -> Finding:
    """Whether the keys for language models can be used, each of them."""
    file = keys.path()
    try:
        hosts = sorted(keys.sources(file))
        for host in hosts:
            keys.key_for(host, file=file)
    except ConfigError as error:
        return Finding(
            name="model keys", verdict="optional", text=str(error),
            cure="see docs/intents.md; only --model needs them",
        )  # fmt: skip
    text = f"for {', '.join(hosts)}" if hosts else f"none; they are named in {file}"
    return Finding(name="model keys", verdict="ok", text=text)


def _cores() -> Finding:
    count = len(os.sched_getaffinity(0))
    if count >= 2:
        return Finding(name="cores", verdict="ok", text=f"{count}")
    return Finding(
        name="cores", verdict="optional", text="1: a live run will be slower than real time",
        cure="use --fast",
    )  # fmt: skip


def _shared_memory() -> Finding:
    """Whether a live run has a place for what its processes share."""
    from robot.bringup import private_folder

    try:
        made = private_folder.create()
    except RobotError as error:
        return Finding(
            name="shared memory", verdict="optional", text=f"no live runs: {error}",
            cure="mount a tmpfs at /dev/shm, or use --fast",
        )  # fmt: skip
    private_folder.remove(made)
    place = made.path.parent
    note = "" if place == private_folder.IN_MEMORY else " (/dev/shm cannot be used)"
    return Finding(name="shared memory", verdict="ok", text=f"{place}{note}")


def _ros2() -> Finding:
    """Whether there is a router on this machine by which ROS 2 machines could see a robot."""
    router = ("127.0.0.1", 7447)
    try:
        socket.create_connection(router, timeout=ROUTER_S).close()
    except OSError:
        return Finding(
            name="ROS 2", verdict="optional",
            text="nothing listens at 127.0.0.1:7447: `up --ros2` waits for a router",
            cure="ros2 run rmw_zenoh_cpp rmw_zenohd, or --ros2-router tcp/HOST:7447 (docs/ros2.md)",
        )  # fmt: skip
    return Finding(
        name="ROS 2", verdict="ok", text="something listens at 127.0.0.1:7447, where its router is"
    )


def _disk(folder: Path) -> Finding:
    where = folder.resolve()
    free_mb = shutil.disk_usage(where).free // 1_000_000
    if not os.access(where, os.W_OK):
        return Finding(
            name="disk", verdict="optional", text=f"{where} cannot be written",
            cure="choose another place with --run-dir",
        )  # fmt: skip
    if free_mb < MIN_FREE_MB:
        return Finding(
            name="disk", verdict="optional", text=f"{free_mb} MB free in {where}",
            cure="make room; a run goes on without a journal on the disk",
        )  # fmt: skip
    return Finding(name="disk", verdict="ok", text=f"{free_mb} MB free")
