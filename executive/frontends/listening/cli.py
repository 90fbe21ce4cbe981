"""The command `humanoid listen`."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import Fast, Model, Robot, RunDir, Seed, World


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


def listen(
    *,
    file: Annotated[
        Path | None, typer.Option("--file", help="A recording (WAV) in place of the microphone.")
    ] = None,
    parse_only: Annotated[
        bool, typer.Option("--parse-only", help="Say what is understood; nothing moves.")
    ] = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="Do what was heard without asking whether it was right.")
    ] = False,
    push_to_talk: Annotated[
        bool, typer.Option("--push-to-talk", help="Listen from Enter to Enter only.")
    ] = False,
    wake_word: Annotated[
        str, typer.Option("--wake-word", help="Sentences have to begin with it.")
    ] = "",
    recogniser: Annotated[
        RecogniserName, typer.Option("--recogniser", help="What turns sound into words.")
    ] = RecogniserName.POCKETSPHINX,
    whisper: Annotated[
        Path | None, typer.Option("--whisper", help="Folder of a Whisper model (ONNX).")
    ] = None,
    voice: Annotated[
        VoiceName, typer.Option("--voice", help="What speaks the answers; they are printed too.")
    ] = VoiceName.AUTO,
    voice_model: Annotated[
        Path | None, typer.Option("--voice-model", help="A voice for piper (ONNX).")
    ] = None,
    device: Annotated[str | None, typer.Option("--device", help="The microphone, by name.")] = None,
    world: World = "kitchen",
    robot: Robot = "juno",
    seed: Seed = 0,
    fast: Fast = False,
    run_dir: RunDir = None,
    model: Model = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="With --parse-only: one JSON object an utterance.")
    ] = False,
) -> None:
    """Listen, and do what is said: into the microphone, or in a recording.

    [bold]Examples[/bold]

      humanoid listen                                  (say: pick up the red cup ... yes)

      humanoid listen --file command.wav --parse-only

      humanoid listen --wake-word juno --world my_house.yaml

    What moves the robot is read back first. "Stop" is heard at any time. Ctrl-C leaves.
    """
    from executive.frontends.listening import hearing

    if as_json and not parse_only:
        raise typer.BadParameter("--json goes with --parse-only")
    if recogniser is RecogniserName.WHISPER and whisper is None:
        raise typer.BadParameter("whisper needs --whisper FOLDER")
    options = hearing.Options(
        world=world, robot=robot, seed=seed, fast=fast, file=file, push_to_talk=push_to_talk,
        wake_word=wake_word, recogniser=recogniser.value, whisper=whisper, voice=voice.value,
        voice_model=voice_model, device=device, parse_only=parse_only, yes=yes, as_json=as_json,
        folder=run_dir, model=model,
    )  # fmt: skip
    with hearing.audio_errors():
        if parse_only:
            raise typer.Exit(hearing.parse_only(options))
        from executive.frontends.listening.obeying import obey

        raise typer.Exit(obey(options))
