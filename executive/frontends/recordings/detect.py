"""What `humanoid detect` does."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from executive.frontends.output import say, write_json
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.pictures import read_colour
from robot.perception.detector.detector import Detection, Detector

NONE_YET = "no model for detection comes along with this software yet"
CURE = (
    "give one of your own: --model FILE.onnx --labels NAMES (YOLO exported to ONNX, and its names; "
    "docs/perception.md)"
)


def detect(
    images: Sequence[Path],
    *,
    model: Path | None,
    labels: Path | None,
    least_score: float,
    overlap: float,
    as_json: bool,
) -> int:
    """Say what is in each picture; a picture that cannot be read is told, and the rest is done.

    Raises:
        ConfigError: there is no model, or it cannot be used.
    """
    if model is None:
        raise ConfigError([Problem(NONE_YET, suggestion=CURE)])
    if labels is None:
        text = "the names of what the model tells apart are missing"
        raise ConfigError([Problem(text, suggestion="--labels FILE: a name a line, or YAML")])
    detector = Detector(model, labels, least_score=least_score, overlap=overlap)
    status = ExitStatus.DONE
    for image in images:
        try:
            picture = read_colour(image)
        except ConfigError as error:
            status = ExitStatus.INVALID
            problem = error.problems[0]
            if as_json:
                write_json({"image": str(image), "error": problem.message})
            else:
                say(str(problem), err=True)
            continue
        found = detector.detect(picture)
        if as_json:
            height, width = picture.shape[:2]
            record = {"image": str(image), "width": width, "height": height}
            write_json({**record, "detections": [_rounded(one) for one in found]})
        else:
            say(f"{image}: {len(found) or 'nothing'}")
            for one in found:
                say(f"  {one.score:.2f}  {one.name}  {', '.join(f'{px:.0f}' for px in one.box)}")
    return status


def _rounded(one: Detection) -> dict[str, object]:
    box = [round(px, 2) for px in one.box]
    return {"name": one.name, "score": round(one.score, 4), "box": box}
