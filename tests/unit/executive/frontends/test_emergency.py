"""Lines about the emergency stop: read in one way, however they are written."""

import pytest

from executive.frontends.emergency import Emergency, emergency, undoes
from intents.stopping import is_stop

RELEASES = (
    "estop release", " EStop   RELEASE ", "estoprelease", "éstop release",
    "ｅｓｔｏｐ ｒｅｌｅａｓｅ", "es\u200btop release", "\x1b[31mestop release",
    "estop\x1b[1m release", "\U0001d41estop release",
)  # fmt: skip
PRESSES = ("estop", "ESTOP!", "estop now", "estop releases", "estop release reset", "estop the arm")
NAMED = (
    "emergency stop", "Emergency stop!", "e-stop", "E STOP!", "E.Stop", "hit the emergency stop",
    "press the e-stop now!!", "STOP! emergency stop!", "emergency-stop", "é-stop", "e\u200b stop",
    "emergency stop " * 5,
)  # fmt: skip
OTHERS = (
    "", "release", "reset", "stop", "walk to the stop", "rest op", "e-stop release",
    "is the emergency stop on?", "emergency stop?", "do not press the e-stop", "emergency",
    "bring me the emergency stop", "what does the e-stop do", "emergency stop " * 10,
)  # fmt: skip


@pytest.mark.parametrize("text", RELEASES)
def test_what_releases_it_does_so_however_it_is_written(text):
    assert emergency(text) == Emergency("release", "")
    assert undoes(text)
    assert emergency(text.replace("release", "reset")) in (Emergency("reset", ""), emergency(text))


@pytest.mark.parametrize("text", PRESSES)
def test_what_else_begins_with_it_presses_it(text):
    said = emergency(text)
    assert said is not None
    assert said.wish == "estop"
    assert not undoes(text)


@pytest.mark.parametrize("text", NAMED)
def test_who_names_it_presses_it(text):
    """The page's button says "E-stop": typed, that was a plain stop, and nothing was latched."""
    assert emergency(text) == Emergency("estop", "")
    assert is_stop(text)  # what is typed before there is a prompt is heard as that


@pytest.mark.parametrize("text", OTHERS)
def test_other_lines_are_not_about_it(text):
    assert emergency(text) is None
    assert not undoes(text)
