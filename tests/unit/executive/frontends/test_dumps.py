"""Pages that are made of tables say what is there."""

from pathlib import Path

from executive.frontends.reference.failures import page

ROOT = Path(__file__).parents[4]


def test_the_page_of_failures_is_current():
    current = (ROOT / "docs" / "failures.md").read_text(encoding="utf-8")
    assert current == page(), (
        "run: python -m executive.frontends.reference.failures docs/failures.md"
    )
