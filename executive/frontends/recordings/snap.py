"""`humanoid sensors snap`: what the robot's camera sees in a world, written down."""

from __future__ import annotations

import io
import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from executive.frontends.composition_root import REALITY
from executive.frontends.new_files import refuse_inputs
from executive.frontends.output import say, write_json
from executive.frontends.recordings.things import boxed, plain, seen_things
from executive.frontends.view import PICTURES
from executive.meaning.request import setting
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import write_ordinary
from robot.messages import RgbdImage
from robot.model.description import RobotDescription
from robot.reality.contract import Plant
from robot.reality.studio import Renderer
from robot.se3 import SE3

if TYPE_CHECKING:
    from PIL.Image import Image

    from executive.frontends.recordings.things import SeenThing

SIZES = "from 16x16 to 1920x1080"


class Asked(msgspec.Struct, frozen=True, kw_only=True):
    """The options of `humanoid sensors snap`; texts as they were typed."""

    world: str
    robot: str
    seed: int
    reality: str
    out: Path
    shows: Literal["both", "colour", "depth"] = "both"
    at: str = ""
    head: str = ""
    size: str = ""
    renderer: Renderer = "auto"
    data: Path | None = None
    finds_things: bool = False
    as_json: bool = False


def snap(asked: Asked) -> int:
    """Take one picture; returns the exit status.

    Raises:
        ConfigError: something asked for cannot be meant, or a file cannot be written.
    """
    refuse_inputs([asked.out, asked.data], [Path(asked.world), Path(asked.robot)])
    _check_names(asked)
    size = _size(asked.size)
    where = setting(REALITY.under(asked.reality), asked.world, robot=asked.robot)
    plant = where.world.plant(where.description, seed=asked.seed)
    _put(plant, where.description, asked)
    with plant.camera(renderer=asked.renderer, size=size) as camera:
        image, by = camera.take(0.0), camera.by
        X_WC = camera.X_WC()
    things = seen_things(image, X_WC) if asked.finds_things else None
    _write(image, things, asked)
    told = _told(image, by, asked)
    if things is not None:
        told["things"] = [plain(one) for one in things]
    if asked.as_json:
        write_json(told)
    else:
        say(
            f"Done: {asked.out}  ({image.width} x {image.height} by {by}, "
            f"{told['fovx_deg']:.0f} x {told['fovy_deg']:.0f} deg, reality {asked.reality}, "
            f"{100 * float(str(told['without_depth'])):.0f} % of the pixels without depth)"
        )
        for one in things or ():
            x, y, z = one.p_W.tolist()
            say(f"  {one.words}, {100.0 * one.name.score:.0f} %, at {x:.2f}, {y:.2f}, {z:.2f} m")
    return ExitStatus.DONE


def _check_names(asked: Asked) -> None:
    if asked.out.suffix.lower() not in PICTURES:
        cure = f"call it {asked.out.stem or 'seen'}.png"
        text = f"pictures are written as {', '.join(PICTURES)}"
        raise ConfigError([Problem(text, str(asked.out), suggestion=cure)])
    if asked.data is not None and asked.data.suffix != ".npz":
        cure = f"call it {asked.data.stem or 'seen'}.npz"
        raise ConfigError([Problem("data is written as .npz", str(asked.data), suggestion=cure)])


def _put(plant: Plant, robot: RobotDescription, asked: Asked) -> None:
    """Stand the robot where it is wanted, and turn its head."""
    if asked.at:
        x_m, y_m, yaw_deg = _numbers(asked.at, 3, "--at", "--at -1.0,-0.5,30")
        plant.stand(SE3.from_xy_yaw(x_m, y_m, math.radians(yaw_deg)))
    if asked.head:
        motors = robot.groups.get("head", ())
        if len(motors) != 2:
            text = f"{robot.name} has no neck that yaws and pitches"
            raise ConfigError([Problem(text, suggestion="turn all of it: --at X,Y,HEADING")])
        angles_deg = _numbers(asked.head, 2, "--head", "--head 20,35")
        plant.pose(dict(zip(motors, map(math.radians, angles_deg), strict=True)))


def _numbers(text: str, count: int, option: str, example: str) -> list[float]:
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(abs(number) < 1e3 for number in numbers):
        problem = f"{option} wants {count} numbers with commas between them, not {text!r}"
        raise ConfigError([Problem(problem, suggestion=f"for example: {example}")])
    return numbers


def _size(text: str) -> tuple[int, int] | None:
    if not text:
        return None
    width, _, height = text.lower().partition("x")
    if width.isascii() and width.isdigit() and height.isascii() and height.isdigit():
        size = int(width[:6]), int(height[:6])
        if 16 <= size[0] <= 1920 and 16 <= size[1] <= 1080:
            return size
    raise ConfigError(
        [Problem(f"{text!r} is no size of a picture", suggestion=f"give one {SIZES}")]
    )


def _write(image: RgbdImage, things: list[SeenThing] | None, asked: Asked) -> None:
    from PIL.Image import fromarray

    from executive.frontends import depth_picture as pictures

    depth_m = image.depth()
    if things is not None:
        picture = boxed(image, things)
    elif asked.shows == "both" or depth_m is None:
        picture = pictures.side_by_side(image)
    elif asked.shows == "depth":
        picture = pictures.in_colours(depth_m, *pictures.span_m(depth_m))
    else:
        picture = image.picture()
    _to_file(asked.out, lambda path: _saved(fromarray(picture), path))
    if asked.data is not None:
        _to_file(asked.data, lambda path: _archived(image, path))


def _to_file(path: Path, write: Callable[[Path], None]) -> None:
    try:
        write(path)
    except OSError as error:
        text = f"cannot be written: {error.strerror}"
        raise ConfigError([Problem(text, str(path), suggestion="choose another file")]) from None


def _saved(picture: Image, path: Path) -> None:
    kind = "PNG" if path.suffix.lower() == ".png" else "JPEG"
    data = io.BytesIO()
    picture.save(data, kind)
    write_ordinary(path, data.getvalue())


def _archived(image: RgbdImage, path: Path) -> None:
    data = io.BytesIO()
    arrays: dict[str, NDArray[Any]] = {"colours": image.picture(), "matrix": image.matrix()}
    if (depth_m := image.depth()) is not None:
        arrays["depth_m"] = depth_m
    np.savez_compressed(data, allow_pickle=False, **arrays)
    write_ordinary(path, data.getvalue())


def _told(image: RgbdImage, by: str, asked: Asked) -> dict[str, object]:
    """All there is to say of a picture, as plain data."""
    depth_m = image.depth()
    without = 1.0 if depth_m is None else float(np.mean(depth_m <= 0.0))
    fx, fy = image.focal_px
    return {
        "picture": str(asked.out), "width": image.width, "height": image.height,
        "by": by, "reality": asked.reality, "frame": image.frame,
        "matrix": image.matrix().tolist(), "exposure_s": image.exposure_s,
        "fovx_deg": math.degrees(2 * math.atan(image.width / 2 / fx)),
        "fovy_deg": math.degrees(2 * math.atan(image.height / 2 / fy)),
        "without_depth": round(without, 4),
    }  # fmt: skip
