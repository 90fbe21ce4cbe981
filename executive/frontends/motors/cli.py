"""The command line of `humanoid motors`."""

from __future__ import annotations

import typer

from executive.frontends.motors.options import (
    Check,
    Identify,
    Jog,
    Log,
    OfMap,
    Rearm,
    Scan,
    SimulateFailsafe,
    Watch,
    Zero,
)
from executive.frontends.options import takes

app = typer.Typer(
    no_args_is_help=True,
    help="Look at real motors (CAN, Dynamixel, Ethernet), or emulated ones. "
    "Only jog and identify enable one.",
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="motors")


@app.command()
@takes(Scan)
def scan(options: Scan) -> None:
    """List the motors on CAN buses: who answers to which identifier, and as what.

    [bold]Examples[/bold]

      humanoid motors scan --channel can0 --channel can1

      humanoid motors scan --channel can2 --data-bitrate 5000000

      humanoid motors scan --map my_arm/can.yaml

      humanoid motors scan --emulated --fail left_knee=twin

      humanoid motors scan --map robot/model/juno/dynamixel.yaml --emulated

    Motors of Damiao, RobStride and moteus, Dynamixel servos and boards behind Ethernet are found.
    Exit status 1 where nobody answers, or two answer as one.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.scan(options))


@app.command()
@takes(OfMap)
def read(options: OfMap) -> None:
    """Say once what every motor of a joint map measures, at its joint.

    [bold]Examples[/bold]

      humanoid motors read --map my_arm/can.yaml

      humanoid motors read --emulated --json
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.read(options))


@app.command()
@takes(Check)
def check(options: Check) -> None:
    """Compare every motor with the joint map, and say what disagrees, with its cure.

    Identifiers, twins, ranges, mode, faults, sign and offset; how full each bus gets; then, for a
    while, whether replies are in time and reported speeds are those of the positions: turn the
    joints by hand meanwhile. Real motors are asked, not enabled.

    [bold]Examples[/bold]

      humanoid motors check --map my_arm/can.yaml --for 10

      humanoid motors check --emulated --fail left_knee=wrong_range

    Exit status 1 where something disagrees that keeps motors from being enabled.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.check(options))


@app.command()
@takes(Watch)
def watch(options: Watch) -> None:
    """Show what every joint measures as a live table, and what is wrong below it.

    [bold]Examples[/bold]

      humanoid motors watch --map my_arm/can.yaml

      humanoid motors watch --emulated --for 5 --every 1 --json

    Ctrl-C ends it. With --json, or where no terminal is, a record or a table after the other.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.watch(options))


@app.command()
@takes(Log)
def log(options: Log) -> None:
    """Write what every joint measures into a new file, a line a period (CSV).

    [bold]Examples[/bold]

      humanoid motors log swing.csv --map my_arm/can.yaml --for 30

      humanoid motors log slow.csv --emulated --for 5 --every 0.1

    Ctrl-C ends it, and the file is whole. A robot that is at work is listened to, on CAN; what
    another program reads of a serial port nobody else hears.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.log(options))


@app.command()
@takes(Zero)
def zero(options: Zero) -> None:
    """Say which offset_rad a joint has that stands, still, at an angle that you know.

    Its motor stays disabled. With --in-motor the motor itself calls this position zero, also when
    it was without power; the map's offset_rad is the angle then.

    [bold]Examples[/bold]

      humanoid motors zero left_knee --at 0 --map my_leg/can.yaml

      humanoid motors zero elbow --at 1.571 --in-motor --map my_arm/can.yaml

      humanoid motors zero wrist --at 0 --map my_arm/dynamixel.yaml
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.zero(options))


@app.command()
@takes(Jog)
def jog(options: Jog) -> None:
    """Move one joint a little way, slowly and weakly; its motor alone is enabled for it.

    Hold the robot up: the motor lets go at the end. Ctrl-C ends it, and it lets go.

    [bold]Examples[/bold]

      humanoid motors jog elbow --by 0.2 --map my_arm/can.yaml

      humanoid motors jog left_knee --by -0.3 --speed 0.1 --torque 0.5 --emulated

    Exit status 1 where it did not get there: something blocks it, or its motor has a fault.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.jog(options))


@app.command()
@takes(Identify)
def identify(options: Identify) -> None:
    """Measure friction, delay and backlash of one joint, by moving it to and fro for a minute.

    Hold the robot up, with 0.25 rad free on both sides: the motor lets go at the end. Ctrl-C ends
    it, and it lets go. What is found is written for simulations, which read it but in ideal.

    [bold]Examples[/bold]

      humanoid motors identify left_knee --map my_robot/can.yaml

      humanoid motors identify elbow --torque 0.5 --map my_arm/can.yaml --to elbow.yaml

      humanoid motors identify left_knee --emulated --fail left_knee=worn

    Exit status 1 where what was found is not sure, 3 where its motor has a fault, or told too
    little.
    """
    from executive.frontends.motors import commands

    raise typer.Exit(commands.identify(options))


@app.command("simulate-failsafe")
@takes(SimulateFailsafe)
def simulate_failsafe(options: SimulateFailsafe) -> None:
    """Lose the controller of a simulated robot that stands, and see what the bus owner does.

    A process that outlives the controller holds the joints, sits the robot down or lets it damp,
    takes the torque off, and lets no controller before it is armed again (docs/safety.md). Every
    rung is told with its time; resets that come too early are tried, too.

    [bold]Examples[/bold]

      humanoid motors simulate-failsafe

      humanoid motors simulate-failsafe --how press --driver simulated

      humanoid motors simulate-failsafe --how stop --json

    Exit status 1 where a torque was over its limit, or somebody was obeyed too early.
    """
    from executive.frontends.motors import failsafe

    raise typer.Exit(failsafe.simulate(options))


@app.command()
@takes(Rearm)
def rearm(options: Rearm) -> None:
    """Let a controller command motors again whose owner has taken their torque off.

    Look at the robot first. It is refused while the motors still give torque, and while the
    emergency stop is pressed. The robot moves only once it is told to.

    [bold]Examples[/bold]

      humanoid motors rearm

    Exit status 1 where it was refused.
    """
    from executive.frontends.motors import failsafe

    raise typer.Exit(failsafe.rearm(options))
