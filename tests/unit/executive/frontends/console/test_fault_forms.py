"""The faults of the page are those of the prompt."""

from __future__ import annotations

import pytest

from executive.frontends.console.faults import UNSEEN, forms
from executive.missions import fault_plans

VALUES = {
    "target": "red_cup",
    "motor": "left_knee",
    "topic": "camera",
    "place": "table",
    "impulse_n_s": "[0,0,-6]",
    "charge": "0.2",
    "delay_s": "0.05",
    "by_m": "[0.3,0]",
}
OTHERWISE = {"move": {"by_m": "[0.3,0,0]"}, "kidnap": {"by_m": "[0.3,0]"}}
"""Faults that want one of two keys."""


def test_every_fault_is_there_but_those_that_end_processes():
    assert {one["name"] for one in forms()} | UNSEEN == set(fault_plans.names())


@pytest.mark.parametrize("form", forms(), ids=lambda form: form["name"])
def test_a_form_filled_in_as_it_asks_is_understood(form):
    """With what is needed alone, and with every default typed out."""
    assert form["help"].endswith(".")
    needed = {key: VALUES.get(key, "1") for key, is_needed, _ in form["keys"] if is_needed}
    needed |= OTHERWISE.get(form["name"], {})
    usual = {key: text for key, is_needed, text in form["keys"] if not is_needed and text}
    for keys in (needed, usual | needed):
        words = " ".join(f"{key}={value}" for key, value in keys.items())
        assert fault_plans.in_words(f"{form['name']} {words}")["fault"] == form["name"]
