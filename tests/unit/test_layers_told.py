"""README and docs/development.md tell of the packages what `.importlinter` holds them to."""

import configparser
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
RULES = configparser.ConfigParser()
RULES.read(ROOT / ".importlinter")


def layers(package: str) -> list[set[str]]:
    """Who stands beside whom, from above to below."""
    lines = RULES[f"importlinter:contract:{package}"]["layers"].split("\n")
    return [set(re.split(r" [|:] ", line.strip())) for line in lines if line.strip()]


@pytest.mark.parametrize("package", ["executive", "robot", "drivers"])
def test_the_page_tells_the_layers(package: str):
    page = (ROOT / "docs" / "development.md").read_text()
    told = re.search(rf"(?m)^- {package}: `([^`]*)`", page)
    assert told is not None
    shown = [set(layer.split(" | ")) for layer in told[1].split(" > ")]
    held = layers(package)
    held = held[held.index(shown[0]) :]
    assert shown == held[: len(shown)]
    assert len(held) - len(shown) <= 2  # what knows nothing of robots; the contracts


@pytest.mark.parametrize("package", ["executive", "robot"])
def test_the_map_names_every_folder(package: str):
    row = re.search(rf"(?m)^\| `{package}/` \| (.*) \|$", (ROOT / "README.md").read_text())
    assert row is not None
    told = set(re.findall(r"`([a-z_]+)`", row[1]))
    folders = {path.parent.name for path in (ROOT / package).glob("*/__init__.py")}
    assert told == folders
