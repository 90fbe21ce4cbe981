"""The command `humanoid listen`."""

from __future__ import annotations

import typer

from executive.frontends.launching import FrontEnd, here, launch
from executive.frontends.listening.options import Listen, RecogniserName
from executive.frontends.options import takes


@takes(Listen)
def listen(options: Listen) -> None:
    """Listen, and do what is said: into the microphone, or in a recording.

    [bold]Examples[/bold]

      humanoid listen                                  (say: pick up the red cup ... yes)

      humanoid listen --file command.wav --parse-only

      humanoid listen --wake-word juno --world my_house.yaml

    What moves the robot is read back first. "Stop" is heard at any time. Ctrl-C leaves.
    """
    if options.as_json and not options.parse_only:
        raise typer.BadParameter("--json goes with --parse-only")
    if options.parse_only:
        for name, given in (("--yes", options.yes), ("--fast", options.fast),
                            ("--run-dir", options.run_dir is not None),
                            ("--view", options.view), ("--record", options.record)):  # fmt: skip
            if given:
                raise typer.BadParameter(f"{name} needs a robot, and --parse-only moves none")
    if options.recogniser is RecogniserName.WHISPER and options.whisper is None:
        raise typer.BadParameter("whisper needs --whisper FOLDER")
    if options.parse_only:
        from executive.frontends.listening import hearing

        raise typer.Exit(hearing.parse_only(options))
    if not options.fast:
        raise typer.Exit(launch(FrontEnd.LISTEN, options))
    from executive.frontends.listening.obeying import in_executive

    raise typer.Exit(here(in_executive, options))
