"""What a key that stops leaves of the line that was being typed: nothing."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from prompt_toolkit.buffer import Buffer
from prompt_toolkit.keys import Keys

from executive.frontends.prompt.keyboard import HEEDED
from executive.frontends.prompt.terminal import Terminal


class Shell:
    """Nothing is under way, and something is asked."""

    def __init__(self) -> None:
        self.robot = SimpleNamespace(busy=False)
        self.speech = SimpleNamespace(hush=lambda: None)
        self.brake = SimpleNamespace(ask_no_more=lambda: True, standing=lambda: "")
        self.out = print


@pytest.mark.parametrize("key", [HEEDED, Keys.ControlC, Keys.ControlBackslash])
def test_a_key_that_stops_clears_the_line(key: Any) -> None:
    shell: Any = Shell()
    bindings = Terminal(shell, history=None)._keys()
    buffer = Buffer()
    buffer.insert_text("go to the table")
    app = SimpleNamespace(layout=SimpleNamespace(is_searching=False), current_buffer=buffer)
    event: Any = SimpleNamespace(app=app, current_buffer=buffer, data="")
    bindings.get_bindings_for_keys((key,))[0].handler(event)
    assert buffer.text == ""
