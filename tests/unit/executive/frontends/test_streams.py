"""Standard streams: whatever becomes of them, who writes goes on."""

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


@pytest.mark.parametrize(("word", "text"), [("cup", "cup"), ("▸", "▸"), ("a\udcffb", "a�b")])
def test_words_can_be_written_into_a_file(word, text):
    assert streams.readable(word) == text
    assert text.encode()
