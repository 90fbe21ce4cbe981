"""The command line of what looks at recordings: `humanoid people`, `detect`, `calibrate`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson

Images = Annotated[
    Path,
    typer.Option("--images", help="Folder of the pictures, or a pattern: 'FOLDER/left*.png'."),
]
Board = Annotated[
    str,
    typer.Option(
        "--board",
        help="chessboard:COLUMNSxROWS:SQUARE (inner corners, metres) or "
        "charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY (squares), with :legacy where OpenCV "
        "before 4.6 printed it.",
    ),
]
Window = Annotated[
    int,
    typer.Option(
        "--corner-window",
        min=2,
        max=50,
        help="Half the window around a chessboard's corner, in pixels; less than half a square.",
    ),
]


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.command(no_args_is_help=True)(people)
    parent.command(no_args_is_help=True)(detect)
    calibrate = typer.Typer(no_args_is_help=True, help="Calibrate sensors from what they recorded.")
    calibrate.command(no_args_is_help=True)(camera)
    calibrate.command(no_args_is_help=True)(hand_eye)
    parent.add_typer(calibrate, name="calibrate")


def people(
    *,
    log: Annotated[
        Path, typer.Option("--log", help="Scans of a planar laser (.npz; docs/perception.md).")
    ],
    causal: Annotated[
        bool,
        typer.Option(
            "--causal", help="As a robot would have known it then: nothing that came later helps."
        ),
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="A JSON line a scan, and nothing else.")
    ] = False,
) -> None:
    """Find the people, and their legs, in the scans of a planar laser.

    With --json a line a scan: t [s], people (id, x, y [m], vx, vy [m/s], score) and legs
    (id of the person, x, y, score), in the laser's frame: x ahead, y to the left.

    [bold]Examples[/bold]

      humanoid people --log corridor.npz

      humanoid people --log corridor.npz --json > people.jsonl
    """
    from executive.frontends.recordings.people import find

    raise typer.Exit(find(log, causal=causal, as_json=as_json))


def camera(
    *,
    images: Images,
    board: Board,
    window: Window = 11,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Write this camera_info file (YAML of ROS).")
    ] = None,
    name: Annotated[str, typer.Option("--name", help="Of the camera, in that file.")] = "camera",
    as_json: AsJson = False,
) -> None:
    """Find a camera's focal lengths, centre and distortion from pictures of a board.

    Tells the residual of every picture, which of them are outlying, and how much of the view is
    covered. Needs OpenCV: pip install 'humanoid-executive[vision]'

    [bold]Examples[/bold]

      humanoid calibrate camera --images pictures/ --board chessboard:9x6:0.025 --out camera.yaml

      humanoid calibrate camera --images 'pictures/left*.png'
      --board charuco:11x8:0.030:0.022:DICT_5X5_100:legacy --json
    """
    from executive.frontends.recordings.camera import calibrate_camera

    status = calibrate_camera(
        images, board=board, window_px=window, out=out, name=name, as_json=as_json
    )
    raise typer.Exit(status)


def hand_eye(
    *,
    images: Images,
    board: Board,
    poses: Annotated[
        Path,
        typer.Option(
            "--poses", help="Where the hand (or the head) was at each picture (docs/perception.md)."
        ),
    ],
    camera: Annotated[
        Path | None,
        typer.Option("--camera", help="camera_info of the camera; without it from these pictures."),
    ] = None,
    window: Window = 11,
    eye_to_hand: Annotated[
        bool,
        typer.Option(
            "--eye-to-hand", help="The camera stands still, and the board is in the hand."
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Find where a camera sits on the hand, or the head, that carries it.

    From pictures of a board that stands still, and the pose of the hand in the base's frame at each
    of them. Turn the hand about two axes at least. Needs OpenCV:
    pip install 'humanoid-executive[vision]'

    [bold]Example[/bold]

      humanoid calibrate hand-eye --images pictures/ --poses poses.csv
      --board charuco:11x8:0.030:0.022:DICT_5X5_100 --camera camera.yaml
    """
    from executive.frontends.recordings.hand_eye import calibrate_hand_eye

    status = calibrate_hand_eye(
        images,
        poses=poses,
        board=board,
        camera=camera,
        window_px=window,
        eye_to_hand=eye_to_hand,
        as_json=as_json,
    )
    raise typer.Exit(status)


def detect(
    images: Annotated[list[Path], typer.Argument(help="Pictures.")],
    *,
    model: Annotated[
        Path | None, typer.Option("--model", help="A network of YOLO's kind (.onnx).")
    ] = None,
    labels: Annotated[
        Path | None,
        typer.Option("--labels", help="Its names: one a line, or YAML with names."),
    ] = None,
    least_score: Annotated[
        float, typer.Option("--score", min=0.0, max=1.0, help="Leave out what is less likely.")
    ] = 0.25,
    overlap: Annotated[
        float,
        typer.Option(
            "--overlap", min=0.0, max=1.0, help="Boxes of one name that share more are one thing."
        ),
    ] = 0.45,
    as_json: Annotated[
        bool, typer.Option("--json", help="A JSON line a picture, and nothing else.")
    ] = False,
) -> None:
    """Say what is in pictures: names, scores and boxes, by a network that you bring along.

    No model comes along with this software yet. With --json a line a picture: image, width,
    height, detections (name, score, box: x1, y1, x2, y2 in pixels), or error where it cannot be
    read.

    [bold]Examples[/bold]

      humanoid detect kitchen.jpg --model yolo11n.onnx --labels coco.yaml

      humanoid detect pictures/*.png --model mine.onnx --labels names.txt --score 0.5 --json
    """
    from executive.frontends.recordings.detect import detect as detect_in

    status = detect_in(
        images,
        model=model,
        labels=labels,
        least_score=least_score,
        overlap=overlap,
        as_json=as_json,
    )
    raise typer.Exit(status)
