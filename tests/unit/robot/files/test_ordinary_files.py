"""Files that are none are refused at once, and links lead nowhere unless they may."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from robot.files.ordinary_files import (
    is_within,
    make_below,
    open_ordinary,
    open_to_append,
    read_ordinary,
    write_ordinary,
)

LIMIT = 10


def test_an_ordinary_file_is_read(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"x" * LIMIT)
    assert read_ordinary(file, limit=LIMIT) == b"x" * LIMIT


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to(path.parents[1])])
@pytest.mark.parametrize("inner", ["a", "a/b"])
def test_folders_are_made_below_another_and_not_through_a_link(tmp_path, make, inner):
    base = tmp_path / "base"
    make_below(base, base / "new" / "newer")
    make_below(base, base / "new" / "newer")
    make_below(base, base)
    assert (base / "new" / "newer").is_dir()
    make(base / "a")
    with pytest.raises(OSError, match=r"a is (a link|no folder)"):
        make_below(base, base / inner)
    with pytest.raises(OSError, match=r"\.\. is no folder below it"):
        make_below(base, tmp_path / "beside")


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


@pytest.mark.parametrize("anew", [False, True])
def test_what_is_written_is_there_and_nothing_else(tmp_path, anew):
    path = tmp_path / "file"
    write_ordinary(path, b"one", anew=anew)
    assert (path.read_bytes(), list(tmp_path.iterdir())) == (b"one", [path])


def test_a_file_is_replaced_but_not_where_it_is_to_be_new(tmp_path):
    path = tmp_path / "file"
    write_ordinary(path, b"one")
    write_ordinary(path, b"two")
    with pytest.raises(FileExistsError):
        write_ordinary(path, b"three", anew=True)
    assert (path.read_bytes(), list(tmp_path.iterdir())) == (b"two", [path])


@pytest.mark.parametrize("write", [lambda path: write_ordinary(path, b"x"), open_to_append])
@pytest.mark.parametrize("kind", ["link", "dangling", "pipe", "device", "folder"])
def test_nothing_is_written_to_what_is_no_file(tmp_path, write, kind):
    other, path = tmp_path / "other", tmp_path / "path"
    other.write_text("kept")
    match kind:
        case "link":
            path.symlink_to(other)
        case "dangling":
            path.symlink_to(tmp_path / "nowhere")
        case "pipe":
            os.mkfifo(path)
        case "device":
            path.symlink_to("/dev/full")
        case _:
            path.mkdir()
    before = sorted(tmp_path.iterdir())
    with pytest.raises(OSError, match=r"link|ordinary"):
        write(path)
    assert (sorted(tmp_path.iterdir()), other.read_text()) == (before, "kept")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a file away")
@pytest.mark.parametrize("write", [lambda path: write_ordinary(path, b"x"), open_to_append])
def test_nothing_is_written_over_what_is_another_users(tmp_path, write):
    path = tmp_path / "theirs"
    path.write_text("kept")
    os.chown(path, 65534, 65534)
    with pytest.raises(OSError, match="another user"):
        write(path)
    assert path.read_text() == "kept"


def test_what_leads_out_of_a_folder_is_not_within_it(tmp_path):
    folder = tmp_path / "folder"
    (folder / "in").mkdir(parents=True)
    (folder / "out").symlink_to(tmp_path)
    (folder / "round").symlink_to(folder / "in")
    inside = [folder, folder / "a", folder / "in" / ".." / "b", folder / "round" / "c"]
    outside = [tmp_path, folder / "..", folder / "out" / "a", tmp_path / "folder2", Path("/")]
    assert [is_within(folder, path) for path in inside + outside] == [True] * 4 + [False] * 5


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o755])
def test_who_may_use_a_file_stays_as_it_was(tmp_path: Path, mode: int) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"before")
    file.chmod(mode)
    write_ordinary(file, b"after")
    assert file.read_bytes() == b"after"
    assert file.stat().st_mode & 0o777 == mode


def test_a_protected_file_is_not_replaced(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_bytes(b"before")
    file.chmod(0o444)
    with pytest.raises(OSError, match="protected"):
        write_ordinary(file, b"after")
    with pytest.raises(OSError, match="protected"):
        open_to_append(file)
    assert file.read_bytes() == b"before"
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
