"""Files that are none are refused at once, and links lead nowhere unless they may."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from robot.ordinary_files import open_ordinary, read_ordinary

LIMIT = 10


def test_an_ordinary_file_is_read(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"x" * LIMIT)
    assert read_ordinary(file, limit=LIMIT) == b"x" * LIMIT


def test_a_file_over_the_limit_is_refused_by_its_size(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"x" * (LIMIT + 1))
    with pytest.raises(OSError, match="larger than"):
        read_ordinary(file, limit=LIMIT)


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir], ids=["pipe", "folder"])
def test_what_is_no_file_is_refused_without_waiting(
    tmp_path: Path, make: Callable[[Path], None]
) -> None:
    make(tmp_path / "thing")
    with pytest.raises(OSError, match=r"no ordinary file|Is a directory"):
        open_ordinary(tmp_path / "thing")


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/tty"])
def test_devices_are_refused(tmp_path: Path, device: str) -> None:
    (tmp_path / "link").symlink_to(device)
    with pytest.raises(OSError, match=r"no ordinary file|No such device"):
        read_ordinary(tmp_path / "link", limit=LIMIT)


def test_a_link_is_followed_only_where_it_may_be(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"text")
    (tmp_path / "link").symlink_to(tmp_path / "file")
    assert read_ordinary(tmp_path / "link", limit=LIMIT) == b"text"
    with pytest.raises(OSError, match="symbolic links"):
        read_ordinary(tmp_path / "link", limit=LIMIT, follow_links=False)
