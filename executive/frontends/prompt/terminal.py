"""The prompt on a terminal: history, completion, a status line that lives, output above it.

Four threads, so that nothing that one of them is about keeps a person from stopping the robot: the
keyboard's hears stops (`keyboard`); the prompt's edits lines and draws; the lines' works them off
in order, however long one takes; the main one hears signals.
"""

from __future__ import annotations

import asyncio
import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

from prompt_toolkit import PromptSession
from prompt_toolkit.auto_suggest import AutoSuggestFromHistory
from prompt_toolkit.filters import is_searching
from prompt_toolkit.formatted_text import StyleAndTextTuples
from prompt_toolkit.history import FileHistory, History, InMemoryHistory
from prompt_toolkit.key_binding import KeyBindings, KeyPress, KeyPressEvent
from prompt_toolkit.keys import Keys
from prompt_toolkit.patch_stdout import patch_stdout
from prompt_toolkit.search import accept_search, stop_search
from prompt_toolkit.shortcuts import CompleteStyle
from prompt_toolkit.styles import Style

from executive.frontends.output import as_mistake
from executive.frontends.prompt.completion import LineCompleter
from executive.frontends.prompt.keyboard import HEEDED, Keyboard
from executive.frontends.prompt.talk import Talk
from executive.frontends.prompt.toolbar import STYLES, toolbar
from intents.letters import without_sequences
from intents.stopping import is_stay, is_stop
from robot.errors import ConfigError, RobotError
from robot.files.exchangeable import check_way
from robot.files.ordinary_files import open_to_append
from robot.files.user_state import user_state_folder

REFRESH_S = 0.2
PANEL_SHARE = 0.5
"""Of the terminal's height that the tree may take."""
LEAVING = ("quit", "exit")
NOT_SUSPENDED = (
    "Ctrl-Z does not suspend the prompt: nobody could stop the robot then. Ctrl-C stops it, Ctrl-D "
    "leaves."
)
GO_WITHOUT_S = 2.0
"""How long the prompt may take to end after a signal: one that writes to a terminal that does not
read never does."""
MOST_MISTAKES = 5
"""So often in a row the prompt itself may fail before it is given up."""


class Terminal:
    """A prompt until the person leaves."""

    def __init__(self, shell: Talk, *, history: Path | None, ahead: bytes = b"") -> None:
        """Prepare.

        Args:
            shell: does what a line says.
            history: the file of what was typed (None: not kept).
            ahead: what was typed before there was a prompt.
        """
        self._shell = shell
        self._history = history
        self._ahead = ahead
        self._worker = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lines")
        self._open_lines = 0
        self._was_heeded = False
        self._prompt: PromptSession[str] | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._error: BaseException | None = None

    def run(self) -> None:
        """Prompt until the person leaves; hears signals, so it belongs in the main thread."""
        interrupts = self._shell.robot.interrupts
        before = interrupts.pressed
        prompting = threading.Thread(target=self._prompting, name="prompt", daemon=True)
        prompting.start()
        try:
            while prompting.is_alive() and interrupts.pressed == before and not interrupts.leaving:
                prompting.join(REFRESH_S)
        finally:
            self._leave()
            prompting.join(GO_WITHOUT_S)
            self._shell.leave()
            self._worker.shutdown(wait=True, cancel_futures=True)
        if self._error is not None:
            raise self._error

    def _leave(self) -> None:
        """End the prompt, from another thread; a signal is a wish to leave."""
        loop, session = self._loop, self._prompt
        if loop is None or session is None:
            return

        def end() -> None:
            self._shell.leaving = True
            if session.app.is_running and not session.app.is_done:
                session.app.exit(exception=EOFError())

        with suppress(RuntimeError):  # it is over
            loop.call_soon_threadsafe(end)

    # --- the prompt's thread ---

    def _prompting(self) -> None:
        keyboard = Keyboard(
            sys.stdin, stop=self._stop_busy, is_cry=self._is_cry, cried=self._cried,
            ahead=self._ahead,
        )  # fmt: skip
        try:
            self._prompt = self._session(keyboard)
            with keyboard, patch_stdout(raw=True):
                asyncio.run(self._run(self._prompt, keyboard))
        except BaseException as error:  # told by who waits
            self._error = error

    def _session(self, keyboard: Keyboard) -> PromptSession[str]:
        shell = self._shell
        vocabulary = shell.dialogue.vocabulary
        return PromptSession(
            "> ",
            input=keyboard,
            history=_history(self._history),
            completer=LineCompleter(shell.commands.values(), vocabulary),
            complete_style=CompleteStyle.COLUMN,
            complete_while_typing=False,
            auto_suggest=AutoSuggestFromHistory(),
            key_bindings=self._keys(),
            bottom_toolbar=self._toolbar,
            refresh_interval=REFRESH_S,
            style=Style.from_dict(STYLES),
        )

    async def _run(self, session: PromptSession[str], keyboard: Keyboard) -> None:
        self._loop = asyncio.get_running_loop()
        self._loop.set_exception_handler(self._mistake)
        mourning = asyncio.create_task(self._mourn())
        try:
            await self._prompt_until_leaving(session, keyboard)
        finally:
            mourning.cancel()

    async def _mourn(self) -> None:
        """Tell that the robot is gone when that happens, also while nothing is asked of it.

        A prompt that has nobody to talk to any more ends.
        """
        while not self._shell.gone:
            await asyncio.sleep(REFRESH_S)
        if self._shell.leaving:
            self._leave()
        else:
            self._shell.answer(self._shell.gone)

    async def _prompt_until_leaving(self, session: PromptSession[str], keyboard: Keyboard) -> None:
        shell, mistakes = self._shell, 0
        while not shell.leaving:
            try:
                # the library's own handler leaves the prompt for a page that waits for Enter
                text = await session.prompt_async(set_exception_handler=False)
            except EOFError:
                shell.leaving = True
                return
            except Exception as error:
                mistakes += 1
                if mistakes >= MOST_MISTAKES:
                    raise
                shell.out(as_mistake(error))
                continue
            mistakes = 0
            heeded, self._was_heeded = self._was_heeded, False
            if heeded:
                shell.out("Stopping.")
            elif text.strip() in LEAVING:
                shell.leaving = True
            elif not self._stopped(text):
                stops = shell.brake.stops  # before looking, so that a stop in between counts
                if keyboard.behind:
                    continue
                self._open_lines += 1
                self._worker.submit(self._line, text, stops)

    def _stopped(self, text: str) -> bool:
        """Whether a line was a cry to stop, heeded here and now."""
        try:
            return self._shell.stop_at_once(text)
        except RobotError as error:
            self._shell.out(f"Not done: {error}")
            return True

    def _mistake(self, _loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """A mistake in what keys or drawing call must not end the prompt, nor hold it up."""
        error = context.get("exception")
        self._shell.out(as_mistake(error) if error else str(context.get("message")))

    # --- the lines' thread ---

    def _line(self, text: str, stops: int) -> None:
        """One line; a mistake in this software must not end the prompt."""
        try:
            self._shell.line(text, stops=stops)
        except Exception as error:
            self._shell.out(as_mistake(error))
        finally:
            self._open_lines -= 1

    # --- stopping, from any thread ---

    @property
    def _busy(self) -> bool:
        """Whether there is something to stop, also a line that may come to something."""
        return self._shell.robot.busy or self._open_lines > 0

    def _stop_busy(self) -> bool:
        """Ctrl-C stops and silences the robot, or closes its question; whether there was one."""
        if self._busy:
            self._shell.brake.stop("the operator pressed Ctrl-C")
            return True
        self._shell.speech.hush()
        return self._shell.brake.ask_no_more()

    def _is_cry(self, line: str) -> bool:
        """Whether a line is to stop something, for all that the prompt has not read it yet.

        One to halt is heeded here, as the emergency stop is; what they say is told as of any line.
        """
        if self._shell.is_emergency(line):
            return False
        if self._busy and (self._shell.brake.is_cry(line) or is_stay(line)):
            return True
        self._shell.halt_at_once(line, busy=self._busy)
        return False

    def _cried(self) -> None:
        """Heed a cry before the prompt has it, which tells of it when it has."""
        self._shell.brake.stop_unsaid("the operator said stop")

    # --- what the library calls ---

    def _toolbar(self) -> StyleAndTextTuples:
        assert self._prompt is not None
        size = self._prompt.output.get_size()
        rows = int(size.rows * PANEL_SHARE)
        return toolbar(self._shell.robot.view, columns=size.columns, rows=rows)

    def _keys(self) -> KeyBindings:
        keys = KeyBindings()

        def stop(event: KeyPressEvent) -> None:
            """Ctrl-C that found nothing to stop as it was pressed; it clears the line."""
            leave_modes(event)
            typed = event.current_buffer.text
            event.current_buffer.reset()
            if not (self._stop_busy() or typed):
                self._shell.out(f"{self._shell.brake.standing()} Ctrl-D or `quit` leaves.")

        def heeded(event: KeyPressEvent) -> None:
            """A line that was heeded is entered as what was heard; a key clears the line.

            What was typed before a stop would else be an order that waits for the next Enter.
            """
            leave_modes(event)
            if not event.data:
                event.current_buffer.reset()
            else:
                self._was_heeded = True
                event.current_buffer.text = event.data
                event.current_buffer.validate_and_handle()

        def search(event: KeyPressEvent) -> None:
            """A cry to stop that was typed into a search is a line, whatever the search found."""
            typed = event.current_buffer.text
            if not (is_stop(typed) or is_stay(typed)):
                accept_search()
                return
            leave_modes(event)
            event.current_buffer.text = typed
            event.current_buffer.validate_and_handle()

        def paste(event: KeyPressEvent) -> None:
            """Each line that was pasted is a line; what follows the last end of one stays."""
            pasted = without_sequences(event.data)
            pieces = pasted.replace("\r\n", "\n").replace("\r", "\n").split("\n")
            event.current_buffer.insert_text(pieces.pop(0))
            typed: list[KeyPress] = []
            for piece in pieces:
                typed += [KeyPress(Keys.Enter, "\r"), KeyPress(Keys.BracketedPaste, piece)]
            event.key_processor.feed_multiple(typed, first=True)

        def suspend(_event: KeyPressEvent) -> None:
            """A prompt that is suspended hears no stop."""
            self._shell.out(NOT_SUSPENDED)

        def ignore(_event: KeyPressEvent) -> None:
            """What is no text: a report of the mouse, for which nobody asked, is a pasted colour.

            Ctrl-S and Ctrl-Q are pressed to hold the screen and let it go.
            """

        add: Callable[..., Callable[[Callable[[KeyPressEvent], None]], object]] = keys.add
        for key in (Keys.ControlC, Keys.ControlBackslash):
            add(key, eager=True)(stop)
        add(HEEDED, eager=True)(heeded)
        add(Keys.Enter, filter=is_searching)(search)
        add(Keys.ControlZ, eager=True)(suspend)
        add(Keys.BracketedPaste)(paste)
        add(Keys.Vt100MouseEvent)(ignore)
        add(Keys.ControlS, filter=~is_searching, eager=True)(ignore)
        add(Keys.ControlQ, eager=True)(ignore)
        return keys


def leave_modes(event: KeyPressEvent) -> None:
    """Leave whatever the line editor is about but the line: a search, a menu, a pending key."""
    app = event.app
    if app.layout.is_searching:
        stop_search()
    app.quoted_insert = False
    app.current_buffer.cancel_completion()
    app.current_buffer.exit_selection()


class _LastingHistory(FileHistory):
    """What was typed before; what cannot be kept or read is left out."""

    def load_history_strings(self) -> list[str]:
        try:
            return list(super().load_history_strings())
        except OSError:
            return []

    def store_string(self, string: str) -> None:
        with suppress(OSError):
            super().store_string(string)


def history_at_home() -> Path | None:
    """Where this user's lines are kept; None without a home."""
    state = user_state_folder()
    return None if state is None else state / "history"


def _history(path: Path | None) -> History:
    """What was typed before, kept where it can be."""
    if path is None:
        return InMemoryHistory()
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        check_way(path.parent, cure="")
        with suppress(FileExistsError):
            os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600))
        os.close(open_to_append(path))  # only an ordinary file of this user's, and through no link
    except (OSError, ConfigError):
        return InMemoryHistory()
    return _LastingHistory(str(path))
