"""The prompt as a person meets it: a real terminal, keystrokes, and the screen they lead to."""

from pathlib import Path

import pytest

from executive.journal.journal import read
from tests.fakes.terminal import CTRL_C, CTRL_D, ENTER, TAB, UP, Terminal
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live


def events(folder: Path, kind: str) -> list:
    return [event for event in read(folder) if event.event == kind]


@pytest.mark.slow
def test_an_evening_at_the_prompt(tmp_path: Path):
    run = tmp_path / "run"
    with Terminal("repl", "--world", "kitchen", "--run-dir", str(run), folder=tmp_path) as terminal:
        assert terminal.shows("`help` shows what can be said")
        assert terminal.shows("stand | "), terminal.text

        terminal.press("what are you hol" + ENTER)
        assert terminal.shows("Not understood")
        terminal.press("pau" + TAB)
        assert terminal.shows("> pause")
        terminal.press(CTRL_C)  # with nothing to stop it clears the line
        assert eventually(lambda: "> pause" not in terminal.text)

        terminal.enter("tree on")
        terminal.enter("go to the table")
        assert terminal.shows("▸ go to the table")
        assert terminal.shows("walk | ")
        terminal.enter("say hello")
        assert terminal.shows("says: Hello.")
        assert terminal.shows("▸ go to the table")

        terminal.enter("pause")
        assert terminal.shows("stand, paused")
        terminal.enter("resume")
        assert terminal.shows("walk | ")
        terminal.press("half a li")
        terminal.press(CTRL_C)
        assert terminal.shows("Stopping.")
        assert eventually(lambda: "> half a li" not in terminal.text)  # or Enter would order it
        assert terminal.shows("stand | ")
        terminal.enter("why")
        assert terminal.shows("Stopped after")
        assert terminal.shows("the operator pressed Ctrl-C")
        terminal.press(UP)
        assert terminal.shows("> why")
        terminal.press(CTRL_C)
        terminal.press(CTRL_D)
        assert eventually(lambda: terminal.process.poll() is not None)
        assert terminal.process.returncode == 0
    jobs = [event.data["state"] for event in events(run, "job") if event.data["job"] == 1]
    assert jobs[-1] == "cancelled"
    assert len(events(run, "pause")) == len(events(run, "resume")) == 1
