"""The command line of `humanoid sensors`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from executive.frontends.options import AsJson, InReality, Robot, Seed, World
from robot.reality.contract import USUAL
from robot.reality.studio import Renderer

app = typer.Typer(
    no_args_is_help=True,
    help="See what the robot's camera sees; work on what real sensors recorded. Nothing moves.",
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="sensors")


@app.command(no_args_is_help=True)
def estimate(
    *,
    log: Annotated[
        Path,
        typer.Option("--log", help="Joints, IMU and forces under the feet (.npz)."),
    ],
    urdf: Annotated[Path, typer.Option("--urdf", help="The robot's URDF; meshes are not needed.")],
    output: Annotated[
        Path, typer.Option("--out", "--output", "-o", help="Text: t x y z qw qx qy qz a sample.")
    ],
    causal: Annotated[
        bool,
        typer.Option(
            "--causal", help="As the robot would have known it then: nothing that came later helps."
        ),
    ] = False,
    feet: Annotated[
        str, typer.Option("--feet", help="Left and right sole: LINK,LINK (default: by name).")
    ] = "",
    imu: Annotated[str, typer.Option("--imu", help="The IMU's link (default: by name).")] = "",
    as_json: AsJson = False,
) -> None:
    r"""Say where the base of a legged robot was, from its own senses alone.

    A contact-aided invariant Kalman filter with gyro and accelerometer bias. The fields of a log,
    and how good it is: docs/state_estimation.md.

    [bold]Examples[/bold]

      humanoid sensors estimate --log walk.npz --urdf robot.urdf --out poses.txt

      humanoid sensors estimate --log walk.npz --urdf robot.urdf --out poses.txt --causal \
        --feet left_sole,right_sole --imu pelvis_imu
    """
    from executive.frontends.recordings.estimate import estimate

    raise typer.Exit(
        estimate(log, urdf, output, causal=causal, feet=feet, imu=imu, as_json=as_json)
    )


@app.command(no_args_is_help=True)
def snap(
    *,
    out: Annotated[
        Path, typer.Option("--out", "--output", "-o", help="The picture to write (.png, .jpg).")
    ],
    world: World = "kitchen",
    robot: Robot = "juno",
    seed: Seed = 0,
    reality: InReality = USUAL,
    show: Annotated[
        Literal["both", "colour", "depth"],
        typer.Option("--show", help="Colours, depth, or both side by side."),
    ] = "both",
    at: Annotated[
        str,
        typer.Option(
            "--at", help="Where it stands: X,Y,HEADING in metres and degrees (default: the start)."
        ),
    ] = "",
    head: Annotated[
        str,
        typer.Option(
            "--head", help="How its head is turned: YAW,PITCH in degrees; left and down are +."
        ),
    ] = "",
    size: Annotated[
        str, typer.Option("--size", help="WIDTHxHEIGHT in pixels (default: the robot's camera).")
    ] = "",
    renderer: Annotated[
        Renderer,
        typer.Option("--renderer", help="rays need nothing; auto takes EGL where it is installed."),
    ] = "auto",
    data: Annotated[
        Path | None,
        typer.Option(
            "--data", help="Write colours, depth_m (metres) and matrix (pixels) as well (.npz)."
        ),
    ] = None,
    things: Annotated[
        bool,
        typer.Option("--things", help="Find and name things; draw boxes on the colours."),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Write what the robot's camera sees in a simulated world: colours, and depth beside them.

    Near is red, far is blue, and black is where no depth was measured. With --reality real or
    harsh the camera is like one that is sold: holes, noise, bad light (docs/realities.md). The same
    seed gives the same picture. With --things two small networks find and name what is in it, as
    they do for a robot at work (docs/perception.md).

    [bold]Examples[/bold]

      humanoid sensors snap --out seen.png

      humanoid sensors snap --world kitchen --at 0.75,0.2,20 --head 0,40 --reality real -o cup.png

      humanoid sensors snap -w flat:7 --size 640x480 --renderer rays -o flat.png --data flat.npz

      humanoid sensors snap --world kitchen --at 0.75,0.2,20 --head 0,40 --things -o things.png
    """
    from executive.frontends.recordings.snap import Asked
    from executive.frontends.recordings.snap import snap as take

    raise typer.Exit(
        take(
            Asked(
                world=world, robot=robot, seed=seed, reality=reality, out=out, shows=show, at=at,
                head=head, size=size, renderer=renderer, data=data, finds_things=things,
                as_json=as_json,
            )
        )
    )  # fmt: skip


@app.command(no_args_is_help=True)
def record(
    *,
    out: Annotated[
        Path, typer.Option("--out", "--output", "-o", help="The folder to write the files to.")
    ],
    world: World = "kitchen",
    robot: Robot = "juno",
    seed: Seed = 0,
    reality: InReality = USUAL,
    longest: Annotated[
        float,
        typer.Option(
            "--for", min=1.0, max=900.0, help="Seconds; it finishes the way that it is on then."
        ),
    ] = 60.0,
    as_json: AsJson = False,
) -> None:
    """Lead a simulated robot through a world, and write what its lidar, legs and IMU say.

    For those who want to try `map build`, `sensors estimate` and `people` and have no recording:
    lidar.npz, legs.npz and robot.urdf are what these read, truth.txt is where the base truly was
    (t x y z qw qx qy qz). Motors and sensors are emulated, with the flaws of the reality
    (docs/realities.md). The same seed gives the same files. No file is overwritten.

    [bold]Examples[/bold]

      humanoid sensors record --out walk

      humanoid sensors record --world flat:7 --for 120 --reality harsh --out flat
    """
    from executive.frontends.recordings.record import Asked
    from executive.frontends.recordings.record import record as write

    raise typer.Exit(
        write(
            Asked(
                world=world, robot=robot, seed=seed, reality=reality, out=out, longest_s=longest,
                as_json=as_json,
            )
        )
    )  # fmt: skip
