"""The files that an MJCF draws in: they stay inside the folder that the model is kept in.

MuJoCo opens whatever an `<include>`, a mesh or a texture names, of any size and kind, a device as
well. So the XML is read first, and every name in it is looked at; nothing is opened but ordinary
files below the folder.
"""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from xml.etree import ElementTree as ET

from robot.errors import DescriptionError, Problem
from robot.files.ordinary_files import is_within, open_ordinary, read_ordinary
from robot.printable import printable

MAX_XML_BYTES = 20_000_000
MAX_DRAWN_IN_BYTES = 500_000_000
"""All meshes and textures together; those of the shipped robots come to 40 MB."""
MAX_FILES = 10_000
MAX_FOLDERS = 20
"""Each is gone through for each name; a published robot names one or two."""
FOLDER_KEYS = ("meshdir", "texturedir", "assetdir")

_BROKEN_NAME = re.compile(
    r"""(?<!\w)(?:file\w*+|(?:mesh|texture|asset)dir)\s*+=\s*+(?:"[^"]*[\t\r\n]|'[^']*[\t\r\n])"""
)


def read(path: Path) -> ET.Element:
    """The XML of a file.

    Raises:
        OSError: it is no ordinary file, or too large.
        ET.ParseError: it is no MJCF, or could be read in two ways.
        UnicodeDecodeError: it is not UTF-8.
    """
    # MuJoCo takes every file for UTF-8, knows no name spaces, and keeps the line breaks in an
    # attribute: whatever would read otherwise here could hide a name from the look at it.
    text = read_ordinary(path, limit=MAX_XML_BYTES).decode()
    if "\0" in text:  # UTF-16 of Latin letters is UTF-8 as well, and expat knows it by these
        raise ET.ParseError("a character stands in it that XML forbids")
    if "<!DOCTYPE" in text:
        raise ET.ParseError("a document type is declared; leave it out")
    if _BROKEN_NAME.search(text):
        raise ET.ParseError("the name of a file or a folder holds a line break or a tab")
    root = ET.fromstring(text)
    if root.tag == "robot":
        raise ET.ParseError("this is a URDF; convert it to MJCF")
    if any(element.tag.startswith("{") for element in root.iter()):
        raise ET.ParseError("a name space is declared; leave it out")
    return root


def check(model: ET.Element, path: Path, folders: Sequence[Path]) -> None:
    """Look at everything that a model draws in, however deep.

    Args:
        model: its XML.
        path: of its file.
        folders: which nothing may lead out of, by a root, by `..`, or by a link.

    Raises:
        DescriptionError: naming the file that is none, too large, or elsewhere.
        OSError: what it includes cannot be read.
        ET.ParseError: what it includes is no XML.
    """
    _must_be_within(path, folders, path)
    documents, seen, below, total = [(model, path.parent)], set[Path](), {""}, 0
    at = 0
    while at < len(documents):
        root, beside = documents[at]
        at += 1
        named = _folders_in(root, {beside, path.parent}, folders, path)
        if not named <= below:  # MuJoCo merges the compilers of all: all names are looked at again
            below, at = below | named, 0
            if len(below) > MAX_FOLDERS:
                raise _too_much(f"it names more than {MAX_FOLDERS} folders", path)
            continue
        for is_model, found in _drawn_in(root, {beside, path.parent, *folders}, below, path):
            if found in seen:
                continue
            seen.add(found)
            _must_be_within(found, folders, path)
            total += _size(found, path)
            if total > MAX_DRAWN_IN_BYTES or len(seen) > MAX_FILES:
                most = f"{MAX_DRAWN_IN_BYTES / 1e6:g} MB, or {MAX_FILES} files"
                raise _too_much(f"it draws in more than {most}", path)
            if is_model:
                documents.append((read(found), found.parent))


def _folders_in(
    root: ET.Element, bases: set[Path], folders: Sequence[Path], path: Path
) -> set[str]:
    """The folders that compilers name; none leads out, whether or not anything is there."""
    named = {one.get(key, "") for one in root.iter("compiler") for key in FOLDER_KEYS}
    for name in named:
        _must_have_no_backslash(name, path)
        if not _may_lead_out(name):
            continue
        ways = [base / name for base in bases]
        if not any(_is_within_either_way(folder, way) for folder in folders for way in ways):
            raise _outside(Path(name), path)
    return named


def _drawn_in(
    root: ET.Element, bases: set[Path], below: set[str], path: Path
) -> Iterator[tuple[bool, Path]]:
    """Whatever is there under a name that the model gives, and whether it is MJCF itself.

    Which of the folders MuJoCo looks in depends on the element; all of them are gone through.
    """
    count = 0
    for element in root.iter():
        for key, name in element.attrib.items():
            if not key.startswith("file") or not name:  # fileright and the like, of a cube
                continue
            count += 1
            if count > MAX_FILES:
                raise _too_much(f"it names more than {MAX_FILES} files", path)
            _must_have_no_backslash(name, path)
            names = {name, os.path.basename(name)}  # noqa: PTH119 - `strippath` leaves that
            every = [base / folder / one for base, folder, one in product(bases, below, names)]
            # MuJoCo takes `a/..` away unseen, the kernel goes where the link `a` leads first.
            every = {way for one in every for way in (one, Path(os.path.normpath(one)))}
            there = [found for found in every if os.path.lexists(found)]
            if not there and _may_lead_out(name):
                raise _outside(Path(name), path)
            for found in there:
                yield element.tag in ("include", "model"), found


def _may_lead_out(name: str) -> bool:
    return Path(name).is_absolute() or ".." in Path(name).parts


def _must_have_no_backslash(name: str, model: Path) -> None:
    if "\\" in name:  # which MuJoCo takes for a slash, and no other reader here does
        text = f"{printable(name)} has a backslash, and may lead outside the robot's folder"
        raise DescriptionError([Problem(text, str(model), suggestion="write / in its place")])


def _is_within_either_way(folder: Path, path: Path) -> bool:
    return is_within(folder, path) and is_within(folder, os.path.normpath(path))


def _must_be_within(found: Path, folders: Sequence[Path], model: Path) -> None:
    if not any(is_within(folder, found) for folder in folders):
        raise _outside(found, model)


def _outside(found: Path, model: Path) -> DescriptionError:
    text = f"{found} is outside the robot's folder"
    return DescriptionError([Problem(text, str(model), suggestion="copy it into the folder")])


def _too_much(text: str, model: Path) -> DescriptionError:
    return DescriptionError([Problem(text, str(model), suggestion="leave some out")])


def _size(found: Path, model: Path) -> int:
    try:
        with open_ordinary(found) as file:
            return os.fstat(file.fileno()).st_size
    except OSError as error:
        if error.errno == errno.EISDIR or found.is_dir():
            return 0  # a folder of the same name; MuJoCo says what it lacks
        text = f"it draws in {found}: {error.strerror}"
        raise DescriptionError([Problem(text, str(model), suggestion="name a file")]) from None
