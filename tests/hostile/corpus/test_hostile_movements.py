"""What a stranger's run says of movements, senses and pictures: films and recordings of it."""

import json
from functools import partial
from pathlib import Path
from typing import Any

from tests.hostile.cases import OUTSIDE, Case, Expect, fifo, folder, sparse
from tests.hostile.corpus.shapes import DIGITS, ESCAPE, Raw, changed, flow
from tests.hostile.exam import exam

FILM = ("film", "-o", "f.gif", "--width", "160", "--speed", "100")
RECORD = ("record", "-o", "r.mcap")
FRONTS = {"film": FILM, "record": RECORD}
FILES = ("motion.jsonl", "sensed.jsonl", "depth.jsonl", "colour.jsonl")

POSE = [0.0, 0.0, 0.6, 1.0, 0.0, 0.0, 0.0]
PICTURE = {
    "t_s": 0.5, "kind": "colour", "type": "png", "width": 8, "height": 8,
    "focal_px": [8.0, 8.0], "centre_px": [4.0, 4.0], "data": "iVBORw0KGgo=",
}  # fmt: skip
FIELDS: dict[str, dict[str, Any]] = {
    "motion.jsonl": {
        "time-1e300": ("t_s", Raw("1e300")),
        "time-minus": ("t_s", -5.0),
        "time-late": ("t_s", 9e8),
        "base-far": ("base", [1e300, -1e300, 1e308, 1.0, 0.0, 0.0, 0.0]),
        "base-no-turn": ("base", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        "base-large-turn": ("base", [0.0, 0.0, 0.0, 1e200, 1e200, 1e200, 0.0]),
        "joints-none": ("q", []),
        "joints-few": ("q", [0.1]),
        "joints-many": ("q", [0.1] * 5000),
        "joints-far": ("q", [1e300] * 33),
        "object-unknown": ("objects", {"nobody_knows": POSE}),
        "object-escape": ("objects", {ESCAPE: POSE}),
        "object-empty": ("objects", {"": POSE}),
        "object-path": ("objects", {"../../x": POSE}),
        "object-the-robot": ("objects", {"juno": POSE, "pelvis": POSE, "world": POSE, "floor": POSE}),
        "object-no-turn": ("objects", {"red_cup": [0.0] * 7}),
        "object-far": ("objects", {"red_cup": [1e300] * 7}),
        "object-gone": ("objects", {"red_cup": None}),
        "objects-many": ("objects", {f"o{n}": POSE for n in range(1000)}),
        "people-unknown": ("people", {"nobody": POSE}),
        "people-escape": ("people", {ESCAPE: POSE}),
        "people-gone": ("people", {"anna": None}),
        "people-far": ("people", {"anna": [1e300] * 7}),
        "held-unknown": ("held", ["nobody_knows"]),
        "held-escape": ("held", [ESCAPE]),
        "held-many": ("held", ["red_cup"] * 5000),
        "charge": ("charge", -1e300),
        "late": ("late", 1e300),
    },
    "sensed.jsonl": {
        "time-1e300": ("t_s", Raw("1e300")),
        "torque-none": ("torque", []),
        "torque-many": ("torque", [1e300] * 5000),
        "heat-few": ("heat", [1e300]),
        "scan-odd": ("scan", {"from_rad": 0.0, "step_rad": 0.1, "ranges_mm": "AAAA"}),
        "scan-empty": ("scan", {"from_rad": 0.0, "step_rad": 0.1, "ranges_mm": ""}),
        "scan-far": ("scan", {"from_rad": 1e300, "step_rad": 1e300, "ranges_mm": "/////w=="}),
        "scan-minus": ("scan", {"from_rad": 0.0, "step_rad": -0.1, "ranges_mm": "/////w=="}),
        "scan-large": ("scan", {"from_rad": 0.0, "step_rad": 0.001, "ranges_mm": "AQEB" * 20000}),
        "sees-escape": ("sees", [ESCAPE]),
        "sees-many": ("sees", ["x"] * 20000),
        "source": ("source", ESCAPE),
        "way-far": ("way", [[1e300, -1e300, 1e300]]),
        "way-many": ("way", [[0.0, 0.0, 0.0]] * 8000),
        "steps-no-foot": ("steps", [[7, 0.0, 0.0, 0.0]]),
        "steps-digits": ("steps", [[Raw(DIGITS[:18]), 1e300, 0.0, 0.0]]),
        "reach-unknown": ("reach", {"kind": "pick", "side": "left", "thing": ESCAPE, "hand": [POSE] * 3, "stance": [0.0] * 3}),
        "reach-far": ("reach", {"kind": "place", "side": "left", "thing": "red_cup", "hand": [[1e300] * 7] * 3, "stance": [1e300] * 3}),
        "arm-no-motor": ("arm", {"side": "left", "motors": [-1, 5000], "times_s": [0.0], "positions": [[0.0]]}),
        "arm-2e9": ("arm", {"side": "left", "motors": [2000000000], "times_s": [0.0, 0.0], "positions": []}),
        "arm-times": ("arm", {"side": "right", "motors": [25, 26], "times_s": [1e300, -1e300], "positions": [[1e300], []]}),
        "arm-none": ("arm", {"side": "right", "motors": [], "times_s": [], "positions": []}),
    },
    "colour.jsonl": {
        "half": ("data", "iVBORw0KGgo="),
        "empty": ("data", ""),
        "no-picture": ("data", "AAAA" * 100),
        "size-2e9": ("width", 2_000_000_000),
        "size-minus": ("height", -8),
        "size-0": ("height", 0),
        "focal-0": ("focal_px", [0.0, 0.0]),
        "focal-far": ("focal_px", [1e300, -1e300]),
        "range": ("range_m", -1e300),
        "time": ("t_s", 1e300),
        "source": ("source", ESCAPE),
    },
}  # fmt: skip


def _field(file: str, field: str, new: Any, run: Path) -> None:
    """Every third line has something else, or something more, in a field."""
    path = run / file
    lines = path.read_text().splitlines() if path.exists() else []
    lines = lines or [json.dumps(PICTURE)] * 4
    for at in range(1, len(lines), 3):
        lines[at] = flow(changed({**json.loads(lines[at]), field: None}, field, new))
    path.write_text("\n".join(lines) + "\n")


def _is(file: str, content: str | bytes, run: Path) -> None:
    path = run / file
    path.unlink(missing_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def _made(file: str, make: Any, run: Path) -> None:
    path = run / file
    path.unlink(missing_ok=True)
    make(path)


def _leads(file: str, to: str, run: Path) -> None:
    path = run / file
    path.unlink(missing_ok=True)
    path.symlink_to(to.replace(OUTSIDE, str(run.parents[2] / "outside")))


SHAPES = {
    "gone": lambda file: partial(_made, file, lambda _path: None),
    "empty": lambda file: partial(_is, file, b""),
    "fifo": lambda file: partial(_made, file, fifo),
    "folder": lambda file: partial(_made, file, folder),
    "zeros": lambda file: partial(_leads, file, "/dev/zero"),
    "secret": lambda file: partial(_leads, file, f"{OUTSIDE}/secret.txt"),
    "binary": lambda file: partial(_is, file, bytes(range(256)) * 1000),
    "deep": lambda file: partial(_is, file, "[" * 50_000 + "\n" + '{"a":' * 5000),
    "utf-16": lambda file: partial(_is, file, '{"t_s": 0.5}\n'.encode("utf-16")),
    "one-line": lambda file: partial(_is, file, b"x" * 20_000_000),
    "sparse": lambda file: partial(_made, file, sparse(100 << 30)),
}

CASES = [
    *(
        Case(
            name=f"{file.partition('.')[0]}-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=partial(_field, file, *change),
            expect=Expect.ENDS,
            cpu_s=20 if front == "film" else 8,
        )
        for file, changes in FIELDS.items()
        for at, (name, change) in enumerate(changes.items())
        for front in (list(FRONTS)[at % 2],)
    ),
    *(
        Case(
            name=f"file-{file}-{name}-{front}",
            argv=FRONTS[front],
            run="short",
            mutate=shape(file),
            expect=Expect.ENDS,
            cpu_s=20 if front == "film" else 8,
        )
        for file in FILES
        for at, (name, shape) in enumerate(SHAPES.items())
        for front in (list(FRONTS)[at % 2],)
    ),
]
test_movements = exam("movements", CASES)
