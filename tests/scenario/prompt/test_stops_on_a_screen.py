"""What a person sees after a stop, whatever the line editor was about: a line to type on."""

import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pyte
import pytest

from benchmarks.prompt_stops import PROGRAM
from tests.fakes.terminal import CTRL_C, CTRL_D, CTRL_U, ENTER, ROWS, Pty, Terminal
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live


class Evening(Terminal):
    """The real prompt before a puppet, with a screen."""

    def __init__(self, folder: Path) -> None:
        self.screen = pyte.Screen(100, ROWS)
        self._stream = pyte.ByteStream(self.screen)
        self._lock = threading.Lock()
        told, self.told = os.pipe()
        self.heard, heard = os.pipe()
        self._fds = (told, self.told, self.heard, heard)
        self._walk = heard
        Pty.__init__(
            self, "-m", PROGRAM, str(folder), str(self.told), str(self.heard), folder=folder,
            pass_fds=(self.told, self.heard),
        )  # fmt: skip

    def walk(self) -> None:
        os.write(self._walk, b"w")
        assert self.shows("walk | "), self.text

    @property
    def line(self) -> str:
        """What is being edited: the last line with a prompt, or the search in its place."""
        return next(
            (one for one in reversed(self.lines) if one.startswith((">", "(reverse", "I-search"))),
            "",
        )

    def close(self) -> None:
        super().close()
        for fd in self._fds:
            os.close(fd)


@pytest.fixture(scope="module")
def evening(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Evening]:
    with Evening(tmp_path_factory.mktemp("run")) as terminal:
        assert eventually(lambda: "stand | " in terminal.text), terminal.text
        yield terminal


def test_ctrl_c_leaves_a_search(evening: Evening):
    for walks in (True, False):
        if walks:
            evening.walk()
        evening.press("\x12st")
        assert evening.shows("reverse-i-search"), evening.text
        evening.press(CTRL_C)
        assert eventually(lambda: "reverse-i-search" not in evening.text), evening.text
        assert evening.shows("stand | ")
        evening.press("watch body")
        assert eventually(lambda: evening.line == "> watch body"), evening.text
        evening.press(CTRL_U)


def test_ctrl_z_is_answered_and_the_next_stop_acts(evening: Evening):
    evening.walk()
    evening.press("\x1a")
    assert evening.shows("Ctrl-Z does not suspend the prompt"), evening.text
    evening.press(CTRL_C)
    assert evening.shows("stand | ")


def test_keys_that_hold_a_screen_leave_nothing_in_the_line(evening: Evening):
    evening.press("watch\x13 bo\x11dy")
    assert eventually(lambda: evening.line == "> watch body"), evening.text
    evening.press(CTRL_U)


@pytest.mark.parametrize("pending", ["\x1d", "\x18", "go to the k\t"])
def test_ctrl_c_leaves_a_pending_key_or_a_menu(evening: Evening, pending: str):
    evening.walk()
    evening.press(pending)
    evening.press(CTRL_C)
    assert evening.shows("stand | ")
    evening.press("\x15watch body")
    assert eventually(lambda: evening.line == "> watch body"), evening.text
    evening.press(CTRL_U)


@pytest.mark.parametrize(
    "typed", ["\x1b[Mstop", "\x1b[M##stop", "\x12stop", "half\x1b[200~a\rstop", "stand still"]
)
def test_the_rest_of_a_heeded_line_says_nothing(evening: Evening, typed: str):
    evening.walk()
    evening.press("\x0c")
    before = evening.text.count("Not understood")
    evening.press(typed + ENTER)
    assert evening.shows("stand | ")
    assert eventually(lambda: evening.line.rstrip() == ">"), evening.text
    assert evening.text.count("Not understood") == before
    assert evening.text.count("Queued") == 0


def test_a_cry_in_a_search_is_a_line_also_when_the_robot_stands(evening: Evening):
    for line in ("watch body", "stop"):  # so that the search finds one
        evening.press(line + ENTER)
    evening.press(f"unwatch body{ENTER}\x0c")
    evening.press("\x12stop")
    assert evening.shows("reverse-i-search"), evening.text
    evening.press(ENTER)
    assert evening.shows("I stand already"), evening.text
    assert eventually(lambda: evening.line.rstrip() == ">"), evening.text
    evening.press("\x12watch")
    assert evening.shows("reverse-i-search"), evening.text
    evening.press(ENTER)  # what is no cry is found, to be edited
    assert eventually(lambda: evening.line.endswith("watch body")), evening.text
    evening.press("\x05" + CTRL_U)


def test_the_late_end_of_a_paste_is_no_text(evening: Evening):
    evening.walk()
    evening.press("\x1b[200~walk to")
    evening.press(CTRL_C)
    assert evening.shows("stand | ")
    evening.press("\x1b[201~\x15watch body")
    assert eventually(lambda: evening.line == "> watch body"), evening.text
    evening.press(CTRL_U)


@pytest.mark.parametrize("walks", [True, False])
def test_the_emergency_stop_is_more_than_a_stop(evening: Evening, walks: bool):
    if walks:
        evening.walk()
    evening.press(f"estop{ENTER}")
    assert evening.shows("Emergency stop. `estop release`"), evening.text
    evening.press(f"status{ENTER}")
    assert evening.shows("the operator pressed the emergency stop"), evening.text
    evening.press(f"estop release{ENTER}")
    assert evening.shows("Released; `estop reset`"), evening.text
    evening.press(f"estop reset{ENTER}")
    assert evening.shows("The robot may move again."), evening.text


def test_it_leaves_last(evening: Evening):
    evening.press(CTRL_D)
    assert eventually(lambda: evening.process.poll() is not None)
