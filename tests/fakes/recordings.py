"""Recordings of others, which some machines have beside the checkout; elsewhere tests skip."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def recordings(*parts: str) -> Path:
    """A folder of them, or the test is skipped."""
    for beside in (ROOT, ROOT.parent):
        folder = beside / "shared" / "recordings" / Path(*parts)
        if folder.is_dir():
            return folder
    pytest.skip(f"the recordings ({'/'.join(parts)}) are not on this machine")
