"""The example of a goal, with every piece copied to where it says: then people can say it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "goal_warm_up.py"
ASKED = """
from executive.meaning.request import request
from executive.trees.parts import errands
from intents import wording
from intents.goals import WarmUp
from tests.fakes.worlds import WHERE
for said in ("warm up for 5 seconds", "limber up", "twice: warm up"):
    print([errand.name for errand in errands(request(said, WHERE).task)])
print(wording.in_words((WarmUp(),)))
"""


def pieces() -> dict[str, str]:
    """What stands below each comment that names a file, by that file."""
    found: dict[str, str] = {}
    name, lines = "", EXAMPLE.read_text().splitlines(keepends=True)
    for before, line in zip(["", *lines], lines, strict=False):
        if line.startswith("# ") and not before.startswith("# "):
            name = line[2:].split(":")[0].split(",")[0].strip()
            found[name] = ""
        elif name and not line.startswith("# "):
            found[name] += line
    return found


def named(piece: str, name: str) -> object:
    values: dict[str, object] = {}
    exec(piece, values)
    return values[name]


def edit(file: Path, *changes: tuple[str, str]) -> None:
    text = file.read_text()
    for old, new in changes:
        assert text.count(old) == 1, (file.name, old)
        text = text.replace(old, new)
    file.write_text(text)


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    for name in ("executive", "intents"):
        skip = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, tmp_path / name, ignore=skip)
    for name in ("robot", "sim", "tests", "missions"):
        (tmp_path / name).symlink_to(ROOT / name)
    of = pieces()
    goals, verbs, frame, wording, handler = of
    assert all((tmp_path / name).is_file() for name in of), "a piece belongs in no file there is"
    sense, spellings = (named(of[verbs], name) for name in ("SENSE", "SPELLINGS"))
    words = named(of[wording], "WORDS")
    edit(tmp_path / goals, ("\nGoal = (\n", f"\n{of[goals]}\nGoal = (\n    WarmUp |\n"))
    rows = "SPELLINGS: dict[str, str] = {\n"
    edit(tmp_path / verbs, (rows, f"{rows}    {sense!r}: {spellings!r},\n"))
    edit(tmp_path / frame, ("    Wait,\n)", "    Wait,\n    WarmUp,\n)"))
    with (tmp_path / frame).open("a") as end:
        end.write(f"\n\n{of[frame]}")
    rows = "FRAMES: dict[str, Frame] = {\n"
    table = tmp_path / "intents/english/frames/__init__.py"
    edit(table, (rows, f"{rows}    {sense!r}: postures.warm_up,\n"))
    stop = '_PLAIN = {g.Stop: "stop"'
    edit(tmp_path / wording, (stop, stop.replace("{", f"{{g.WarmUp: {words!r}, ")))
    goals_too = "from intents import goals\n"
    needed = "from executive.trees.parts import Series\nfrom intents.goals import WarmUp\n"
    edit(tmp_path / handler, (goals_too, goals_too + needed))
    with (tmp_path / handler).open("a") as end:
        end.write(f"\n\n{of[handler]}")
    rows = "HANDLERS: dict[type[Any], Handler] = {\n"
    tasks = tmp_path / "executive/meaning/tasks.py"
    edit(tasks, (rows, f"{rows}    goals.WarmUp: moving.warming_up,\n"))
    return tmp_path


def test_people_can_say_it(copied: Path):
    command = [sys.executable, "-c", ASKED]
    ours = {**os.environ, "PYTHONPATH": str(copied)}
    ran = subprocess.run(command, cwd=copied, env=ours, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.splitlines() == [
        "['squat for 5 s', 'lean for 5 s']",
        "['squat for 3 s', 'lean for 3 s']",
        "['squat for 3 s', 'lean for 3 s', 'squat for 3 s', 'lean for 3 s']",
        "warm up",
    ]
