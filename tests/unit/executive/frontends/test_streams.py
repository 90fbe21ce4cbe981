"""Standard streams: whatever becomes of them, who writes goes on."""

import errno
import io
import os
import subprocess
import sys

import pytest

from executive.frontends import output, streams

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


class Broken(io.RawIOBase):
    """A file that takes nothing."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.file = os.open(os.devnull, os.O_WRONLY)

    def writable(self):
        return True

    def fileno(self):
        return self.file

    def write(self, _data):
        raise OSError(self.number, os.strerror(self.number))


@pytest.mark.parametrize(
    ("number", "why"),
    [
        (errno.ENOSPC, "No space left"),
        (errno.EFBIG, "too large"),
        (errno.EPIPE, ""),
        (errno.EIO, ""),
    ],
)
def test_what_a_disk_did_not_take_is_missed_and_what_nobody_reads_is_not(monkeypatch, number, why):
    out = streams.Lasting(io.BufferedWriter(Broken(number)), encoding="utf-8")
    monkeypatch.setattr(sys, "stdout", out)
    out.write("x" * 100_000)
    told, product = streams.lost()
    assert (why in told if why else not told) and product
    streams.beside_work()
    assert streams.lost() == (told, False)
    out.detach()


def test_a_file_that_nobody_reads_to_its_end_is_no_loss_and_a_full_disk_is_one(monkeypatch):
    for number, why in ((errno.EPIPE, ""), (errno.ENOSPC, "No space left")):
        out = streams.Lasting(io.BufferedWriter(Broken(number)), encoding="utf-8")
        monkeypatch.setattr(sys, "stdout", out)
        output.write_data(b"x" * 100_000)
        told, _ = streams.lost()
        assert why in told if why else not told
        out.detach()


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
