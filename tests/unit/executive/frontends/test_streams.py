"""Standard streams: whatever becomes of them, who writes goes on."""

import os
import subprocess
import sys

import pytest

from executive.frontends import streams

TALK = """
import sys
from executive.frontends import streams
streams.steady()
line = sys.stdin.readline()
for number in range(20000):
    print(number, line, "\\u25b8")
sys.stdout.flush()
print("to the end", file=sys.stderr)
open(sys.argv[1], "w").write("done")
"""


@pytest.fixture
def ends(tmp_path):
    """Whether a program that talks gets to its end, with its streams as a shell would have them."""

    def run(how: str) -> tuple[int, str]:
        done = tmp_path / "done"
        words = ["sh", "-c", f'"$0" -c "$1" "$2" {how}', sys.executable, TALK, str(done)]
        shell = subprocess.run(words, capture_output=True, check=False, input=b"\xff\n")
        assert done.read_text() == "done"
        return shell.returncode, shell.stderr.decode()

    return run


@pytest.mark.parametrize(
    "how", ["| head -n 1", ">/dev/full", ">&-", "<&-", ">&- 2>&- <&-", "2>/dev/full >&2", ""]
)
def test_whoever_closed_them_it_goes_to_its_end(ends, how):
    status, told = ends(how)
    assert status == 0
    assert told in ("", "to the end\n")


def test_letters_that_the_stream_does_not_have_are_replaced(ends, monkeypatch):
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    assert ends(">/dev/null")[0] == 0


def test_a_stream_that_somebody_put_there_stays(capsys):
    before = sys.stdout, sys.stderr
    streams.steady()
    assert (sys.stdout, sys.stderr) == before


@pytest.mark.parametrize("size", ["1000000000", "9" * 5001, "-1", "abc", "", "80.5", "\x1b[2J"])
def test_a_terminal_of_no_size_that_there_is_is_asked_for_its_own(monkeypatch, size):
    for name in ("COLUMNS", "LINES"):
        monkeypatch.setenv(name, size)
    streams.sized()
    assert not {"COLUMNS", "LINES"} & set(os.environ)


def test_a_size_that_is_one_is_kept(monkeypatch):
    monkeypatch.setenv("COLUMNS", "132")
    streams.sized()
    assert os.environ["COLUMNS"] == "132"
