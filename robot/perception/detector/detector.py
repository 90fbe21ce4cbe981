"""Names, scores and boxes of the things in a picture, by a network of YOLO's kind."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robot.errors import ConfigError, Problem
from robot.files.pictures import Picture
from robot.perception.detector.labels import read_labels
from robot.perception.detector.letterbox import letterboxed
from robot.perception.detector.network import Network
from robot.perception.detector.overlaps import without_overlaps
from robot.perception.detector.yolo import decoded

LEAST_SCORE, OVERLAP = 0.25, 0.45
"""As YOLO's own tools have them."""


@dataclass(frozen=True, kw_only=True)
class Detection:
    """A thing in a picture; the box is x1, y1, x2, y2 [px], from the upper left corner."""

    name: str
    score: float
    box: tuple[float, float, float, float]


class Detector:
    """A network with the names of what it tells apart."""

    def __init__(
        self,
        model: Path,
        labels: Path,
        *,
        least_score: float = LEAST_SCORE,
        overlap: float = OVERLAP,
    ) -> None:
        """Load both; raises ConfigError if either cannot be used."""
        self._labels = labels
        self._names = read_labels(labels)
        self._network = Network(model)
        self._model = model
        self._least_score, self._overlap = least_score, overlap

    def detect(self, picture: Picture) -> tuple[Detection, ...]:
        """The things in a picture (red, green, blue), the likeliest first.

        Raises:
            ConfigError: the network's output does not fit the names.
        """
        tensor, letterbox = letterboxed(picture, self._network.size)
        try:
            candidates = decoded(self._network(tensor), len(self._names))
        except ValueError as error:
            cure = f"give the labels that it was trained with; {self._labels} has"
            cure = f"{cure} {len(self._names)} names"
            raise ConfigError([Problem(str(error), str(self._model), suggestion=cure)]) from None
        kept = candidates[
            without_overlaps(candidates, least_score=self._least_score, overlap=self._overlap)
        ]
        size = (picture.shape[1], picture.shape[0])
        boxes: list[list[float]] = letterbox.boxes_in_picture(kept.boxes, size).tolist()
        return tuple(
            Detection(
                name=self._names[int(kept.names[number])],
                score=float(kept.scores[number]),
                box=(box[0], box[1], box[2], box[3]),
            )
            for number, box in enumerate(boxes)
        )
