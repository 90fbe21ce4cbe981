"""The prompt on a terminal: history, completion, a status line that lives, output above it.

Lines are worked off in order in a thread of their own, so that nothing that a line takes (a plan,
a long sentence) keeps the prompt from hearing a stop.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from prompt_toolkit import PromptSession
from prompt_toolkit.auto_suggest import AutoSuggestFromHistory
from prompt_toolkit.formatted_text import StyleAndTextTuples
from prompt_toolkit.history import FileHistory, History, InMemoryHistory
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.patch_stdout import patch_stdout
from prompt_toolkit.shortcuts import CompleteStyle
from prompt_toolkit.styles import Style

from executive.frontends.prompt.completion import LineCompleter
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.toolbar import STYLES, toolbar
from robot.errors import RobotError

REFRESH_S = 0.2
PANEL_SHARE = 0.5
"""Of the terminal's height that the tree may take."""
LEAVING = ("quit", "exit")


class Terminal:
    """A prompt until the person leaves."""

    def __init__(self, shell: Shell, *, history: Path | None) -> None:
        """Prepare; `history` is the file of what was typed (None: not kept)."""
        self._shell = shell
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lines")
        vocabulary = shell.robot.where.knowledge.vocabulary()
        self._prompt: PromptSession[str] = PromptSession(
            "> ",
            history=_history(history),
            completer=LineCompleter(shell.commands.values(), vocabulary),
            complete_style=CompleteStyle.COLUMN,
            complete_while_typing=False,
            auto_suggest=AutoSuggestFromHistory(),
            key_bindings=self._keys(),
            bottom_toolbar=self._toolbar,
            refresh_interval=REFRESH_S,
            style=Style.from_dict(STYLES),
        )

    def run(self) -> None:
        """Prompt until the person leaves."""
        with patch_stdout(raw=True):
            asyncio.run(self._run())
        self._worker.shutdown(wait=True, cancel_futures=True)

    async def _run(self) -> None:
        besides = [asyncio.create_task(one) for one in (self._leave_on_signal(), self._mourn())]
        try:
            await self._prompt_until_leaving()
        finally:
            for task in besides:
                task.cancel()

    async def _leave_on_signal(self) -> None:
        """A signal from outside (the terminal was closed, SIGTERM) is a wish to leave."""
        while not self._shell.robot.interrupts.count:
            await asyncio.sleep(REFRESH_S)
        if self._prompt.app.is_running:
            self._prompt.app.exit(exception=EOFError())

    async def _mourn(self) -> None:
        """Tell that the robot is gone when that happens, also while nothing is asked of it."""
        while not self._shell.gone:
            await asyncio.sleep(REFRESH_S)
        self._shell.answer(self._shell.gone)

    async def _prompt_until_leaving(self) -> None:
        shell = self._shell
        while not shell.leaving:
            try:
                text = await self._prompt.prompt_async()
            except EOFError:
                shell.leaving = True
                return
            if text.strip() in LEAVING:
                shell.leaving = True
            elif not self._stopped(text):
                self._worker.submit(self._line, text)

    def _stopped(self, text: str) -> bool:
        """Whether a line was a cry to stop, heeded here and now."""
        try:
            return self._shell.stop_at_once(text)
        except RobotError as error:
            self._shell.out(f"Not done: {error}")
            return True

    def _line(self, text: str) -> None:
        """One line; a mistake in this software must not end the prompt."""
        try:
            self._shell.line(text)
        except Exception as error:
            kind = type(error).__name__
            self._shell.out(f"That is a mistake in this software: {kind}: {error}")

    def _toolbar(self) -> StyleAndTextTuples:
        size = self._prompt.output.get_size()
        rows = int(size.rows * PANEL_SHARE)
        return toolbar(self._shell.robot.view, columns=size.columns, rows=rows)

    def _keys(self) -> KeyBindings:
        keys = KeyBindings()

        def stop(event: KeyPressEvent) -> None:
            """Ctrl-C silences and stops the robot; with nothing to stop it clears the line."""
            self._shell.speech.hush()
            if self._shell.robot.busy:
                self._shell.stop("the operator pressed Ctrl-C")
            elif event.current_buffer.text:
                event.current_buffer.reset()
            else:
                self._shell.out("The robot stands. Ctrl-D or `quit` leaves.")

        add: Callable[..., Callable[[Callable[[KeyPressEvent], None]], object]] = keys.add
        add("c-c", eager=True)(stop)
        return keys


def _history(path: Path | None) -> History:
    """What was typed before, kept where it can be."""
    if path is None:
        return InMemoryHistory()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch(mode=0o600)
    except OSError:
        return InMemoryHistory()
    return FileHistory(str(path))
