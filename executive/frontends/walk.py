"""`humanoid walk`: the body alone, at a steady velocity."""

from __future__ import annotations

from contextlib import ExitStack

from executive.engine.loop import Interrupts
from executive.frontends import streams
from executive.frontends.composition_root import REALITY
from executive.frontends.console.attending import attended
from executive.frontends.console.beside import shown
from executive.frontends.driving import chosen
from executive.frontends.dump.record import recorded
from executive.frontends.exit import refuse
from executive.frontends.launching import folder_for
from executive.frontends.only_stopping import OnlyStopping
from executive.frontends.options import Walk
from executive.frontends.output import Screen, say, write_json
from executive.journal import failures
from executive.meaning import request
from executive.runs import lidar_maps, runtimes, velocity_walk
from executive.runs.runtimes import Setup
from executive.runs.summary import clamped_words, late_periods
from executive.runs.velocity_walk import VelocityCommand, Walked
from executive.runs.walk_record import WalkRecord
from robot.clock import WallClock
from robot.exit_status import exit_status
from robot.messages import BodyState

TEXT = "walk"
"""What the run is about, and what its folder is called by, where one is kept."""


def walk(options: Walk) -> int:
    """Walk, then stand; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    eyes = "oracle" if options.eyes == "auto" else options.eyes  # nothing is looked for
    where = request.setting(
        REALITY.under(options.reality, eyes=eyes),
        options.world,
        robot=options.robot,
    )
    where = lidar_maps.localised(where, options.localisation, tell=_say_nothing)
    command = VelocityCommand(
        forward_m_s=options.speed,
        left_m_s=options.left,
        turn_rad_s=options.turn,
        duration_s=options.duration,
    )
    refusal = velocity_walk.check(command, where.description)
    if refusal is not None:
        return refuse(request.refused(refusal), as_json=options.as_json)
    streams.beside_work()
    interrupts, wall = Interrupts(), WallClock()
    begun_s = wall.now_s()
    kind: runtimes.Kind = "fast" if options.fast else "live"
    driver = chosen(options.driver, where.description, fast=options.fast, err=options.as_json)
    kept = options.view or options.record or options.run_dir is not None
    folder = folder_for(options.run_dir, TEXT) if kept else None
    setup = Setup(
        where=where, kind=kind, seed=options.seed, pictures=options.camera, driver=driver,
        folder=folder,
    )  # fmt: skip
    with (
        shown(folder, wanted=options.view, err=options.as_json),
        recorded(folder, wanted=options.record, err=options.as_json),
        interrupts.listen(),
        runtimes.opened(setup) as robot,
        ExitStack() as stack,
    ):
        runtime, record = robot.runtime, None
        if folder is not None:
            record = stack.enter_context(WalkRecord(setup, robot, folder, text=TEXT))
            page = OnlyStopping(interrupts, lambda text: say(text, err=True))
            stack.enter_context(attended(page, folder, None))
        with Screen(quiet=options.as_json).status("walking") as status:

            def show(body: BodyState) -> None:
                status.update(f"walking: {body.stamp_s:.0f} of {command.duration_s:.0f} s")
                if record is not None:
                    record.look()

            walked = velocity_walk.walk(runtime, command, interrupts=interrupts, on_tick=show)
        if record is not None:
            record.end(walked)
        past_s = runtime.clock.now_s()
        late = late_periods(runtime)
    if options.as_json:
        write_json(walked)
    else:
        lines = _words(walked, past_s, wall.now_s() - begun_s)
        say("\n".join([*lines, *(f"  {line}" for line in late)]))
    return exit_status(walked.failure)


def _say_nothing(_text: str) -> None:
    """It walks where nothing is in its way, and does not ask where it is."""


def _words(walked: Walked, past_s: float, wall_s: float) -> list[str]:
    reason = walked.failure
    lines = [
        failures.verdict(reason),
        f"  walked {walked.walked_s:.1f} s: {walked.forward_m:.2f} m forward, "
        f"{walked.left_m:.2f} m to the left, {walked.turned_rad:.2f} rad turned (estimated)",
        f"  {past_s:.1f} s of robot time in {wall_s:.1f} s ({past_s / wall_s:.1f} x), "
        + clamped_words(walked.clamped, walked.most_clamped),
    ]
    if reason is not None:
        lines += failures.advice(failures.suggestion(reason.code, reason.suggestion))
    return lines
