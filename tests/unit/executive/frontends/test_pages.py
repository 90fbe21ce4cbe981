"""The pages of the documentation say what the tables say."""

from pathlib import Path

import pytest

from executive.frontends.reference import PAGES, TABLES, filled

DOCS = Path(__file__).parents[4] / "docs"


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_up_to_date(name):
    text = (DOCS / name).read_text(encoding="utf-8")
    assert filled(text) == text, "python -m executive.frontends.reference docs"


def test_every_table_has_its_place():
    text = "".join((DOCS / name).read_text(encoding="utf-8") for name in PAGES)
    assert all(f"<!-- table: {name} -->" in text for name in TABLES)
