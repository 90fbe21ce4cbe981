"""The options of `humanoid listen`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import Kept, Place, Reading, Seeded, Viewed


class RecogniserName(StrEnum):
    """Recognisers to choose from."""

    POCKETSPHINX = "pocketsphinx"
    WHISPER = "whisper"


class VoiceName(StrEnum):
    """Voices to choose from."""

    AUTO = "auto"
    NONE = "none"
    ESPEAK = "espeak-ng"
    PIPER = "piper"


@dataclass(frozen=True, kw_only=True)
class Listen(Place, Seeded, Viewed, Kept, Reading):
    """The options of `humanoid listen`."""

    file: Annotated[
        Path | None, typer.Option("--file", help="A recording (WAV) in place of the microphone.")
    ] = None
    parse_only: Annotated[
        bool, typer.Option("--parse-only", help="Say what is understood; nothing moves.")
    ] = False
    yes: Annotated[
        bool, typer.Option("--yes", help="Do what was heard without asking whether it was right.")
    ] = False
    push_to_talk: Annotated[
        bool, typer.Option("--push-to-talk", help="Listen from Enter to Enter only.")
    ] = False
    wake_word: Annotated[
        str, typer.Option("--wake-word", help="Sentences have to begin with it.")
    ] = ""
    recogniser: Annotated[
        RecogniserName, typer.Option("--recogniser", help="What turns sound into words.")
    ] = RecogniserName.POCKETSPHINX
    whisper: Annotated[
        Path | None, typer.Option("--whisper", help="Folder of a Whisper model (ONNX).")
    ] = None
    voice: Annotated[
        VoiceName, typer.Option("--voice", help="What speaks the answers; they are printed too.")
    ] = VoiceName.AUTO
    voice_model: Annotated[
        Path | None, typer.Option("--voice-model", help="A voice for piper (ONNX).")
    ] = None
    device: Annotated[str | None, typer.Option("--device", help="The microphone, by name.")] = None
    as_json: Annotated[
        bool, typer.Option("--json", help="With --parse-only: one JSON object an utterance.")
    ] = False
