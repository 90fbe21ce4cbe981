"""What the commands of `humanoid motors` do."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from rich.console import Group
from rich.live import Live
from rich.text import Text

from executive.frontends.composition_root import REALITY
from executive.frontends.motors import tables
from executive.frontends.motors.options import (
    Check,
    Identify,
    Jog,
    Log,
    OfMap,
    Scan,
    Watch,
    Zero,
)
from executive.frontends.new_files import refuse_taken
from executive.frontends.output import say, table_screen, write_json
from robot.bringup import can_tools, motor_bench, motor_identify, motor_log, motor_tools
from robot.bringup.end_wish import EndWish
from robot.bringup.motor_reports import Check as Checked
from robot.bringup.motor_reports import Seen, Watched
from robot.bringup.motor_tools import Joints
from robot.clock import WallClock
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.model import identified


def scan(asked: Scan) -> int:
    """Look who is on CAN interfaces, or on the buses of a joint map; returns the exit status.

    Raises:
        DriverError: if one of them cannot be opened.
    """
    if asked.channel:
        buses = can_tools.nameless(asked.channel, asked.interface, asked.data_bitrate_hz)
        return _scanned(buses, asked, label="")
    with _joints(asked) as (joints, label):
        return _scanned(joints, asked, label=label)


def _scanned(joints: Joints, asked: Scan, *, label: str) -> int:
    found = motor_tools.scan(joints, WallClock(), up_to=asked.up_to)
    return _seen(found, asked, label=label, buses=len(joints.channels))


def _seen(found: Sequence[Seen], asked: Scan, *, label: str, buses: int) -> int:
    twins = [one for one in found if one.replies > 1]
    status = ExitStatus.FAILED if twins or not found else ExitStatus.DONE
    if asked.as_json:
        write_json({"emulated": bool(label), "motors": found})
        return status
    if found:
        table_screen().print(tables.of_scan(found))
    for one in twins:
        say(f"{one.replies} motors answer to {one.id} on {one.bus}: unplug one, change its id")
    if not found:
        say("Nobody answers: are the motors powered, is the bus terminated, is its bit rate right?")
    say(f"{len(found)} identifiers of 1 to {asked.up_to} answer on {buses} buses{label}.")
    return status


def read(asked: OfMap) -> int:
    """Say what every motor measures; returns the exit status."""
    with _joints(asked) as (joints, label):
        rows = motor_tools.read(joints, WallClock())
    silent = [row.joint for row in rows if row.status == "silent"]
    status = ExitStatus.FAILED if silent else ExitStatus.DONE
    if asked.as_json:
        write_json({"emulated": bool(label), "joints": rows})
        return status
    table_screen().print(tables.of_readings(rows))
    say(f"{len(rows) - len(silent)} of {len(rows)} motors answered{label}.")
    if silent:
        say("humanoid motors check says what may be wrong with the others.")
    return status


def check(asked: Check) -> int:
    """Compare motors with their map; returns the exit status."""
    with _joints(asked) as (joints, label):
        if not asked.as_json:
            say(f"Asking {len(joints.joints)} motors{label}, then reading for {asked.for_s:g} s.")
        found = motor_tools.check(joints, WallClock(), for_s=asked.for_s)
    status = ExitStatus.FAILED if found.is_grave else ExitStatus.DONE
    if asked.as_json:
        write_json({"emulated": bool(label), "is_grave": found.is_grave, "check": found})
        return status
    table_screen().print(tables.of_loads(found.loads))
    _tell(found)
    if any(one.code == "assumed" for one in found.findings):
        say(f"The chips of {found.joints} servos answer{label}; the servos say nothing.")
    elif found.is_grave:
        say("Not one motor may be enabled before that is put right.")
    elif any(one.code == "late" for one in found.findings):
        say(
            f"All {found.joints} motors are what the map says{label}; not all replies came in time."
        )
    else:
        say(f"All {found.joints} motors are what the map says{label}.")
    return status


def _tell(found: Checked) -> None:
    still = [one for one in found.findings if one.code == "not_moved"]
    for one in found.findings:
        if one in still:
            continue
        mark, style = ("no", "red") if one.is_grave else ("--", "yellow")
        say(f"{mark}  {one.joint}: {one.text}", styled=(mark, style))
        say(f"    cure: {one.cure}", styled=("    cure:", "dim"))
    if still:
        names = ", ".join(one.joint for one in still)
        say(f"--  {still[0].text}: {names}", styled=("--", "yellow"))
        say(f"    cure: {still[0].cure}", styled=("    cure:", "dim"))
    if found.answered is not None:
        say(f"ok  {found.answered:.2%} of all replies came within their period")


def watch(asked: Watch) -> int:
    """Show what joints measure, again and again; returns the exit status."""
    with _joints(asked) as (joints, label):
        shown = motor_tools.watch(joints, WallClock(), every_s=asked.every_s, for_s=asked.for_s)
        with suppress(KeyboardInterrupt):
            _show(shown, as_json=asked.as_json, label=label)
    return ExitStatus.DONE


def _show(shown: Watched, *, as_json: bool, label: str) -> None:
    if as_json:
        for rows, alarms in shown:
            write_json({"emulated": bool(label), "joints": rows, "alarms": alarms})
        return
    screen = table_screen()
    if not screen.is_terminal:
        for rows, alarms in shown:
            screen.print(tables.of_readings(rows))
            say("\n".join(alarms or (f"all is well{label}",)))
        return
    with Live(console=screen, auto_refresh=False, vertical_overflow="crop") as live:
        for rows, alarms in shown:
            words = Text("\n".join(alarms) or f"all is well{label}", "red" if alarms else "green")
            live.update(Group(tables.of_readings(rows), words), refresh=True)


def log(asked: Log) -> int:
    """Write what joints measure into a file; returns the exit status.

    Raises:
        ConfigError: if the file is there already, or cannot be written.
    """
    refuse_taken(asked.file)
    with _joints(asked) as (joints, label):
        if not asked.as_json:
            say(f"Writing {asked.file} for {asked.for_s:g} s{label}; Ctrl-C ends it.")
        try:
            with asked.file.open("x", encoding="utf-8") as out:
                logged = motor_log.log(
                    joints, WallClock(), out, for_s=asked.for_s, every_s=asked.every_s
                )
        except OSError as error:
            cure = "choose another name, or make room"
            text = f"it cannot be written: {error.strerror}"
            raise ConfigError([Problem(text, str(asked.file), suggestion=cure)]) from None
    if asked.as_json:
        write_json({"emulated": bool(label), "file": str(asked.file), "logged": logged})
    else:
        late = f"{logged.lost} replies were late or lost"
        say(f"{logged.rows} lines of {logged.span_s:.2f} s are in {asked.file}{label}; {late}.")
    return ExitStatus.DONE if logged.rows else ExitStatus.FAILED


def zero(asked: Zero) -> int:
    """Say which offset a joint has; returns the exit status.

    Raises:
        DriverError: if its motor is not still, or does not take its zero.
    """
    with _joints(asked, is_still=True) as (joints, label):
        motor_bench.only(joints, asked.joint)
        if not asked.as_json:
            say(f"Hold {asked.joint} still at {asked.at_rad:g} rad{label}.")
        found = motor_bench.zero(
            joints, asked.joint, WallClock(), at_rad=asked.at_rad, in_motor=asked.in_motor
        )
    if asked.as_json:
        write_json({"emulated": bool(label), "zero": found})
        return ExitStatus.DONE
    say(f"{found.joint} stands at {found.was_rad:.4f} rad by the map as it is.")
    if found.is_in_motor:
        say("Its motor calls this position zero from now on.")
    say(f"Write offset_rad: {found.offset_rad:.4f} at {found.joint} into {joints.file}.")
    return ExitStatus.DONE


def jog(asked: Jog) -> int:
    """Move one joint a little way; returns the exit status.

    Raises:
        DriverError: if its motor cannot be enabled, or was not seen to let go.
    """
    clock = WallClock()
    with EndWish(clock) as wish:  # until all is said: else nobody knows whether the motor let go
        with _joints(asked, is_still=True) as (joints, label):
            motor_bench.only(joints, asked.joint)
            if not asked.as_json:
                say(f"Moving {asked.joint} by {asked.by_rad:g} rad{label}; Ctrl-C stops it.")
            moved = motor_bench.jog(
                joints,
                asked.joint,
                clock,
                by_rad=asked.by_rad,
                speed_rad_s=asked.speed_rad_s,
                torque_share=asked.torque,
                wish=wish,
            )
        return _tell_of_jog(moved, emulated=bool(label), as_json=asked.as_json)


def _tell_of_jog(moved: motor_bench.Jogged, *, emulated: bool, as_json: bool) -> int:
    is_there = moved.ending == "there"
    if as_json:
        write_json({"emulated": emulated, "jog": moved})
        return ExitStatus.DONE if is_there else ExitStatus.FAILED
    if not is_there:
        say(f"no  {moved.joint}: {moved.why}", styled=("no", "red"))
    way = f"{moved.from_rad:.3f} to {moved.to_rad:.3f} rad (asked {moved.goal_rad:.3f})"
    say(f"{moved.joint} went from {way}; at most {moved.most_nm:.2f} of {moved.limit_nm:.2f} N m.")
    say("Its motor has let go.")
    return ExitStatus.DONE if is_there else ExitStatus.FAILED


def identify(asked: Identify) -> int:
    """Measure what a joint is like; returns the exit status.

    Raises:
        DriverError: if its motor cannot be enabled, was not seen to let go, or told too little.
        ConfigError: it has no room, or what is found cannot be written.
    """
    clock = WallClock()
    with EndWish(clock) as wish, _joints(asked, is_still=True) as (joints, label):
        motor_bench.only(joints, asked.joint)
        if not asked.as_json:
            say(f"Moving {asked.joint} to and fro{label}; Ctrl-C stops it.")
        found = motor_identify.identify(
            joints, asked.joint, clock, torque_share=asked.torque, wish=wish
        )
    path = asked.to
    if path is None and not label:
        path = motor_tools.map_path(asked.robot, asked.map_file).with_name(identified.FILE)
    if not found.is_sure:
        path = None
    if path is not None:
        _keep(path, found)
    status = ExitStatus.DONE if found.is_sure else ExitStatus.FAILED
    if asked.as_json:
        write_json({"emulated": bool(label), "file": path and str(path), "identified": found})
        return status
    say(
        f"{found.joint}: friction {found.friction_nm:.3f} ± {found.friction_error_nm:.3f} N m, "
        f"{found.viscous_nm_s:.3f} more a rad/s; delay {1000 * found.delay_s:.2f} ± "
        f"{1000 * found.delay_error_s:.2f} ms; backlash {1000 * found.backlash_rad:.2f} ± "
        f"{1000 * found.backlash_error_rad:.2f} mrad; inertia {found.inertia_kg_m2:.4f} kg m²."
    )
    if not found.is_sure:
        say("no  that is not sure enough: is the computer busy, is something loose?")
    say(f"Its motor has let go. {f'It is in {path}.' if path else 'Nothing is written.'}")
    return status


def _keep(path: Path, found: motor_identify.Identified) -> None:
    joint = identified.Joint(
        friction_nm=max(0.0, found.friction_nm),
        viscous_nm_s=max(0.0, found.viscous_nm_s),
        delay_s=max(0.0, found.delay_s),
        backlash_rad=max(0.0, found.backlash_rad),
    )
    try:
        identified.write(path, {found.joint: joint})
    except OSError as error:
        cure = "choose another place with --to"
        text = f"it cannot be written: {error.strerror}"
        raise ConfigError([Problem(text, str(path), suggestion=cure)]) from None


@contextmanager
def _joints(asked: OfMap, *, is_still: bool = False) -> Generator[tuple[Joints, str]]:
    """The joint map, and how it is said that its motors are emulated where they are.

    Raises:
        ConfigError: with everything that is wrong in the map and in what was asked.
    """
    path = motor_tools.map_path(asked.robot, asked.map_file)
    if not asked.emulated:
        if asked.fail:
            cure = "add --emulated, or leave --fail out"
            raise ConfigError([Problem("only emulated motors fail on request", suggestion=cure)])
        yield motor_tools.load_map(path), ""
        return
    flaws = _flaws(asked.fail or ())
    with REALITY.motors(path, flaws=flaws, is_still=is_still) as buses:
        yield motor_tools.load_map(path, buses.channels), " (emulated)"


def _flaws(fail: Sequence[str]) -> Mapping[str, str]:
    wrong = [one for one in fail if "=" not in one]
    if wrong:
        cure = "write JOINT=FLAW, as in left_knee=silent"
        raise ConfigError(
            [Problem(f"--fail {one!r} names no flaw", suggestion=cure) for one in wrong]
        )
    return dict(one.split("=", 1) for one in fail)
