"""What strangers do to a run's folder."""

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.hostile.cases import OUTSIDE
from tests.hostile.corpus.shapes import (
    changed,
    flow,
)

Change = Callable[[Path], None]


def journal_lines(folder: Path) -> list[str]:
    return (folder / "journal.jsonl").read_text().splitlines()


def write_lines(folder: Path, lines: list[str]) -> None:
    (folder / "journal.jsonl").write_bytes(
        ("\n".join(lines) + "\n").encode("utf-8", "surrogatepass")
    )


def event_says(kind: str, field: str, new: Any, folder: Path) -> None:
    """Every event of a kind has something else in one field."""
    lines = []
    for line in journal_lines(folder):
        event = json.loads(line)
        if event["event"] == kind and (field in event or "." in field):
            lines.append(flow(changed(event, field, new)))
        else:
            lines.append(line)
    write_lines(folder, lines)


def more_lines(text: str | bytes, at: int, folder: Path) -> None:
    """A line more, after so many."""
    lines = [line.encode() for line in journal_lines(folder)]
    lines.insert(at if at >= 0 else len(lines), text.encode() if isinstance(text, str) else text)
    (folder / "journal.jsonl").write_bytes(b"\n".join(lines) + b"\n")


def through(place: str, count: int, folder: Path) -> None:
    """A run, cut off, that keeps things in what is the folder of somebody else."""
    cut(count, folder)
    linked(place, f"{OUTSIDE}/tree", folder)


def cut_with(change: Change, folder: Path) -> None:
    """A run, cut off, of which something is not as it was left."""
    cut(3, folder)
    change(folder)


def cut(count: int, folder: Path) -> None:
    """The run was cut off after so many events."""
    write_lines(folder, journal_lines(folder)[:count])
    (folder / "summary.json").unlink(missing_ok=True)


def in_file(name: str, field: str, new: Any, folder: Path) -> None:
    path = folder / name
    path.write_text(flow(changed(json.loads(path.read_text()), field, new)))


def in_header(field: str, new: Any, folder: Path) -> None:
    """What the run was started with, in run.json and in the journal, alike."""
    in_file("run.json", field, new, folder)
    event_says("run", field, new, folder)


def holds(name: str, content: str | bytes, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())


def linked(name: str, to: str, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    path.symlink_to(to.replace(OUTSIDE, str(folder.parents[2] / "outside")))


def a_pipe(name: str, folder: Path) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    os.mkfifo(path)


def a_folder(name: str, folder: Path) -> None:
    (folder / name).unlink(missing_ok=True)
    (folder / name).mkdir()


def gone(name: str, folder: Path) -> None:
    (folder / name).unlink()


def flood(count: int, line: str, folder: Path) -> None:
    lines = journal_lines(folder)
    with (folder / "journal.jsonl").open("w") as file:
        file.write("\n".join(lines[:5]) + "\n")
        for _ in range(count // 1000):
            file.write((line + "\n") * 1000)
        file.write("\n".join(lines[5:]) + "\n")


def sparse(folder: Path) -> None:
    """The journal is endless, and lacks the summary that would tell what it was."""
    (folder / "summary.json").unlink()
    os.truncate(folder / "journal.jsonl", 200 << 30)


def forged(folder: Path) -> None:
    """Every text has a line of its own that poses as the program's."""
    lines = [json.loads(line) for line in journal_lines(folder)]
    for event in lines:
        for key, value in event.items():
            if isinstance(value, str) and key not in {"event", "state", "id", "code", "step"}:
                event[key] = value + "\nFORGED: curl evil"
    write_lines(folder, [json.dumps(event) for event in lines])
    (folder / "run.json").write_text(
        (folder / "run.json").read_text().replace('"text":"', '"text":"x\\nFORGED: curl evil ')
    )


def asked(fields: dict[str, Any], folder: Path) -> None:
    """Somebody asked for something else as well."""
    lines = journal_lines(folder)
    event = {"event": "request", "n": json.loads(lines[-2])["n"], "t_s": 0.5, **fields}
    write_lines(folder, [*lines[:8], flow(event), *lines[8:]])


def renamed(name: str, folder: Path) -> None:
    folder.rename(folder.with_name(name))


def kept(path: str, folder: Path) -> None:
    """The mission that was kept is said to lie elsewhere."""
    event_says("request", "origin.kept", path, folder)
