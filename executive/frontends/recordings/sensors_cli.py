"""The command line of `humanoid sensors`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson

app = typer.Typer(
    no_args_is_help=True, help="Work on what real sensors recorded, without moving a robot."
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
