"""Lines about the emergency stop: read in one way, however they are written."""

import pytest

from executive.frontends.emergency import Emergency, emergency, undoes

RELEASES = (
    "estop release", " EStop   RELEASE ", "estoprelease", "éstop release",
    "ｅｓｔｏｐ ｒｅｌｅａｓｅ", "es\u200btop release", "\x1b[31mestop release",
    "estop\x1b[1m release", "\U0001d41estop release",
)  # fmt: skip
PRESSES = ("estop", "ESTOP!", "estop now", "estop releases", "estop release reset", "estop the arm")
OTHERS = ("", "release", "reset", "stop", "e stop", "walk to the stop", "rest op", "e-stop release")


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


@pytest.mark.parametrize("text", OTHERS)
def test_other_lines_are_not_about_it(text):
    assert emergency(text) is None
    assert not undoes(text)
