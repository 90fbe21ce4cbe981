"""The files that an MJCF draws in: they stay inside the folder that the model is kept in.

MuJoCo opens whatever an `<include>`, a mesh or a texture names, of any size and kind, a device as
well. So the XML is read first, and every name in it is looked at; nothing is opened but ordinary
files below the folder.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from xml.etree import ElementTree as ET

from robot.errors import DescriptionError, Problem
from robot.ordinary_files import is_within, open_ordinary, read_ordinary

MAX_XML_BYTES = 20_000_000
MAX_DRAWN_IN_BYTES = 500_000_000
"""All meshes and textures together; those of the shipped robots come to 40 MB."""
MAX_FILES = 10_000


def read(path: Path) -> ET.Element:
    """The XML of a file.

    Raises:
        OSError: it is no ordinary file, or too large.
        ET.ParseError: it is no XML, or declares entities.
    """
    data = read_ordinary(path, limit=MAX_XML_BYTES)
    if b"<!DOCTYPE" in data:  # an entity could hide a name from what is read here
        raise ET.ParseError("a document type is declared; leave it out")
    return ET.fromstring(data)


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
    seen: set[Path] = set()
    waiting, total = [(model, path.parent)], 0
    while waiting:
        root, beside = waiting.pop()
        for is_model, found in _drawn_in(root, {beside, path.parent, *folders}, path):
            if found in seen:
                continue
            seen.add(found)
            _must_be_within(found, folders, path)
            total += _size(found, path)
            if total > MAX_DRAWN_IN_BYTES or len(seen) > MAX_FILES:
                text = (
                    f"it draws in more than {MAX_DRAWN_IN_BYTES / 1e6:g} MB, or {MAX_FILES} files"
                )
                raise DescriptionError([Problem(text, str(path), suggestion="leave some out")])
            if is_model:
                waiting.append((read(found), found.parent))


def _drawn_in(root: ET.Element, bases: set[Path], path: Path) -> Iterator[tuple[bool, Path]]:
    """Whatever is there under a name that the model gives, and whether it is MJCF itself.

    Which of its folders MuJoCo looks in depends on the element; all of them are gone through.
    """
    folders = {""}
    for compiler in root.iter("compiler"):
        folders |= {compiler.get(key, "") for key in ("meshdir", "texturedir", "assetdir")}
    for element in root.iter():
        for key, name in element.attrib.items():
            if not key.startswith("file") or not name:  # fileright and the like, of a cube
                continue
            names = {name, os.path.basename(name)}  # noqa: PTH119 - `strippath` leaves that
            every = [base / below / one for base, below, one in product(bases, folders, names)]
            there = [found for found in every if os.path.lexists(found)]
            if not there and (Path(name).is_absolute() or ".." in Path(name).parts):
                raise _outside(Path(name), path)
            for found in there:
                yield element.tag in ("include", "model"), found


def _must_be_within(found: Path, folders: Sequence[Path], model: Path) -> None:
    if not any(is_within(folder, found) for folder in folders):
        raise _outside(found, model)


def _outside(found: Path, model: Path) -> DescriptionError:
    text = f"{found} is outside the robot's folder"
    return DescriptionError([Problem(text, str(model), suggestion="copy it into the folder")])


def _size(found: Path, model: Path) -> int:
    try:
        with open_ordinary(found) as file:
            return os.fstat(file.fileno()).st_size
    except OSError as error:
        if error.errno == errno.EISDIR or found.is_dir():
            return 0  # a folder of the same name; MuJoCo says what it lacks
        text = f"it draws in {found}: {error.strerror}"
        raise DescriptionError([Problem(text, str(model), suggestion="name a file")]) from None
