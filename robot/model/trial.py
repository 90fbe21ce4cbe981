"""A stranger's MJCF is compiled in a process of its own first, with little memory and little time.

A few lines of MJCF make millions of bodies (`replicate`, `composite`, nested `attach`), textures
and height fields of any size, an arena of terabytes; no count of elements beforehand sees them all.
So another process tries, the kernel holds it to its limits, and it tells how large the model is.
"""

from __future__ import annotations

import json
import math
import os
import resource
import subprocess
import sys
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any, TypeAlias

import msgspec
import mujoco
import numpy as np
from msgspec import Meta

import robot
from robot.errors import DescriptionError, Problem
from robot.files.misfits import misfits
from robot.model import mjcf
from robot.printable import printable

MEMORY_BYTES = 400_000_000
"""What compiling may take on top of the libraries. The G1 takes 350 MB: its meshes."""
OUT_OF_MEMORY = ("allocate memory", "unknown exception")
"""How MuJoCo tells it: its own allocator, and what the C++ library throws through it."""
CPU_S = 3
"""The G1 takes 0.6 s, the Booster T1 0.4 s."""
WALL_S = 10.0
"""Only a file that is waited for (a pipe in the place of a mesh) takes that long without CPU."""

_CODE = "import sys; sys.path.insert(0, sys.argv[1]); from robot.model import trial; trial.main()"
_ROOT = str(Path(robot.__file__).resolve().parent.parent)
_ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MALLOC_ARENA_MAX": "1"}


def _up_to(most: float, unit: str = "") -> Meta:
    return Meta(ge=0, le=most, extra={"unit": unit})


_Iterations: TypeAlias = Annotated[int, _up_to(1000)]


class Size(msgspec.Struct, frozen=True, kw_only=True):
    """How large a compiled model is, and what a step of it may cost.

    A humanoid has 40 bodies, 55 geoms and a mass of 35 kg; a hand with five fingers adds 20 bodies.
    """

    bodies: Annotated[int, _up_to(500)]
    degrees_of_freedom: Annotated[int, _up_to(300)]
    geoms: Annotated[int, _up_to(2000)]
    sites: Annotated[int, _up_to(2000)]
    sensors: Annotated[int, _up_to(2000)]
    memory_mb: Annotated[float, _up_to(120, "MB")]
    texture_mb: Annotated[float, _up_to(16, "MB")]
    mass_kg: Annotated[float, Meta(ge=0.5, le=500, extra={"unit": "kg"})]
    joint_range_rad: Annotated[float, _up_to(1000, "rad")]
    iterations: _Iterations
    ls_iterations: _Iterations
    noslip_iterations: _Iterations
    ccd_iterations: _Iterations
    sdf_iterations: _Iterations


def check(source: mjcf.Source) -> None:
    """Whether a model can be compiled here, within bounds; the same content is tried once.

    Raises:
        DescriptionError: it cannot, is too large, or holds numbers that no robot has.
    """
    # The trial works elsewhere: of a relative folder it would make another one.
    where = msgspec.structs.replace(
        source,
        path=_from_anywhere(source.path),
        folder=_from_anywhere(source.folder),
        overlay=source.overlay and _from_anywhere(source.overlay),
        overlay_folder=_from_anywhere(source.overlay_folder),
    )
    file = source.overlay or source.path
    problems = _tried(where, source.content())
    if problems:
        raise DescriptionError([Problem(text, file, suggestion=cure) for text, cure in problems])


def _from_anywhere(path: str) -> str:
    return str(Path(path).resolve())


@lru_cache(maxsize=8)  # the key holds the MJCF itself
def _tried(source: mjcf.Source, _content: bytes) -> list[tuple[str, str]]:
    """What is wrong, with the cure."""
    command = [sys.executable, "-P", "-c", _CODE, _ROOT, msgspec.json.encode(source).decode()]
    with TemporaryDirectory() as folder:  # MuJoCo leaves its log where it works
        try:
            tried = subprocess.run(
                command, env={**os.environ, **_ONE_THREAD}, cwd=folder, stdin=subprocess.DEVNULL,
                timeout=WALL_S, capture_output=True, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return [_too_much(f"{WALL_S:g} s")]
    try:
        answer = msgspec.json.decode(tried.stdout, type=dict[str, Any])
    except msgspec.DecodeError:
        return [_too_much(f"{CPU_S} s and {MEMORY_BYTES / 1e6:g} MB")]
    if any(sign in str(answer.get("error")) for sign in OUT_OF_MEMORY):
        return [_too_much(f"{MEMORY_BYTES / 1e6:g} MB")]
    if "error" in answer:
        return [(f"the MJCF does not compile: {printable(str(answer['error']))[:2000]}", "")]
    return [(f"the MJCF's {one.message}", "make it smaller") for one in misfits(answer, Size)]


def _too_much(of: str) -> tuple[str, str]:
    text = f"the MJCF takes more than {of} to compile"
    return text, "leave out replicate and composite, large textures, meshes, height fields, size"


def main() -> None:
    """In the process of its own: compile, and write what came of it."""
    source = msgspec.json.decode(sys.argv[2], type=mjcf.Source)
    # What is compiled once needs no copy of its meshes for the next time: 150 MB of the G1.
    mujoco.mj_setCacheCapacity(mujoco.mj_getCache(), 0)
    _limit()
    try:
        answer = msgspec.to_builtins(_measured(source))
    except MemoryError:
        return
    except Exception as error:  # MuJoCo raises what it likes
        text = error.problems[0].message if isinstance(error, DescriptionError) else str(error)
        answer = {"error": text.removeprefix("the MJCF does not compile: ")}
    sys.stdout.write(json.dumps(answer))


def _limit() -> None:
    """From here on memory and time are short; the libraries are loaded already."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    most = pages * resource.getpagesize() + MEMORY_BYTES
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    used_s = math.ceil(sum(resource.getrusage(resource.RUSAGE_SELF)[:2]))
    resource.setrlimit(resource.RLIMIT_CPU, (used_s + CPU_S, used_s + CPU_S))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _measured(source: mjcf.Source) -> dict[str, float]:
    model: Any = mjcf.compiled(source)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    if not np.isfinite(data.qacc).all():
        raise ValueError("its motion is not finite: look at masses, inertias and gains")
    ranges = np.abs(model.jnt_range[model.jnt_limited.astype(bool)])
    return {
        "bodies": model.nbody,
        "degrees_of_freedom": model.nv,
        "geoms": model.ngeom,
        "sites": model.nsite,
        "sensors": model.nsensor,
        "memory_mb": (model.nbuffer + model.narena) / 1e6,
        "texture_mb": model.ntexdata / 1e6,
        "mass_kg": float(model.body_mass.sum()),
        "joint_range_rad": float(ranges.max(initial=0.0)),
        "iterations": model.opt.iterations,
        "ls_iterations": model.opt.ls_iterations,
        "noslip_iterations": model.opt.noslip_iterations,
        "ccd_iterations": model.opt.ccd_iterations,
        "sdf_iterations": model.opt.sdf_iterations,
    }
