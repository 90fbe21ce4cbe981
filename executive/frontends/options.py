"""Options that several commands of the command line share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

World = Annotated[
    str, typer.Option("--world", "-w", help="A shipped world by name, or a world file (YAML).")
]
Robot = Annotated[
    str, typer.Option("--robot", "-r", help="A shipped robot by name, or a robot file (YAML).")
]
Seed = Annotated[int, typer.Option("--seed", "-s", min=0, help="Of everything random.")]
Fast = Annotated[
    bool,
    typer.Option(
        "--fast", help="As fast as the machine goes, and the same every time, in one process."
    ),
]
Vary = Annotated[
    bool, typer.Option("--vary", help="Shuffle the start and the objects by the seed.")
]
RunDir = Annotated[
    Path | None,
    typer.Option("--run-dir", help="Where the journal goes (default: runs/STAMP-WORDS)."),
]
Model = Annotated[
    Path | None,
    typer.Option(
        "--model",
        envvar="HUMANOID_MODEL",
        help="Language model (an endpoint's TOML file) to ask what the grammar cannot read.",
    ),
]
Aloud = Annotated[
    bool, typer.Option("--voice", help="Say aloud what is answered and asked, and how it ended.")
]
VoiceModel = Annotated[
    Path | None,
    typer.Option("--voice-model", help="The same with piper, in this voice (ONNX)."),
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object, and nothing else.")]
