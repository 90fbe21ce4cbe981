"""What a skill is at stands in a sentence: "I fell while waving", "no plan while walking"."""

import ast
from pathlib import Path
from typing import get_args

import executive.skills
from executive.skills.gesture import DOING, GestureKind


def first_words() -> list[str]:
    """Of every text that is a skill's phase somewhere, as far as it is written out."""
    found = []
    for path in sorted(Path(executive.skills.__file__).parent.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text())):
            targets = node.targets if isinstance(node, ast.Assign) else []
            if any(isinstance(one, ast.Attribute) and one.attr == "phase" for one in targets):
                texts = [one.value for one in ast.walk(node.value) if isinstance(one, ast.Constant)]
                found += [text for text in texts[:1] if isinstance(text, str) and text]
    return found


def test_every_phase_is_something_that_one_can_be_at():
    assert len(first_words()) > 30
    assert [text for text in first_words() if not text.split()[0].endswith("ing")] == []


def test_every_gesture_has_words_for_doing_it():
    assert set(DOING) == set(get_args(GestureKind))
    assert all(words.split()[0].endswith("ing") for words in DOING.values())
