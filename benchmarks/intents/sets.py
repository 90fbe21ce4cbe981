"""Sets of commands with their own scorer, from a folder that is no part of this project."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import msgspec

from intents.outcomes import to_record
from intents.parser import parse
from intents.vocabulary import Names

SCORER = "score.py"


def problem(folder: Path) -> str:
    """Why nothing can be measured with a folder; empty if it can."""
    if not folder.is_dir():
        return f"there is no folder {folder}"
    if not (folder / SCORER).is_file():
        return f"{folder} has no {SCORER}, which compares goals with those of a set"
    if not list(folder.glob("*.jsonl")):
        return f"{folder} has no set NAME.jsonl with its NAME.vocab.json"
    return ""


def names(folder: Path) -> list[str]:
    """The sets that have a vocabulary."""
    return sorted(
        path.stem
        for path in folder.glob("*.jsonl")
        if path.with_name(f"{path.stem}.vocab.json").is_file()
    )


def texts(folder: Path, name: str) -> list[str]:
    """What was said in a set."""
    lines = (folder / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()
    return [json.loads(line)["text"] for line in lines if line.strip()]


def score(folder: Path, name: str, work: Path) -> dict[str, Any]:
    """Parse a set and score it; the predictions stay in `work`."""
    vocabulary = msgspec.json.decode(
        (folder / f"{name}.vocab.json").read_bytes(), type=Names
    ).vocabulary()
    parse("warm up", vocabulary)
    predictions = work / f"{name}.predictions.jsonl"
    with predictions.open("w", encoding="utf-8") as out:
        for text in texts(folder, name):
            out.write(json.dumps(to_record(text, parse(text, vocabulary))) + "\n")
    command = [sys.executable, SCORER, f"{name}.jsonl", str(predictions), "--json"]
    found = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    return json.loads(found.stdout)
