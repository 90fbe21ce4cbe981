"""`humanoid mission run`: the same work as a sentence, with steps left out, limits and faults."""

from __future__ import annotations

from executive.frontends import carrying_out
from executive.frontends.carrying_out import Prepared
from executive.frontends.composition_root import REALITY
from executive.frontends.launching import folder_for, from_plain_options
from executive.frontends.missions.commands import said, say_notes
from executive.frontends.missions.options import Run
from executive.frontends.prompt.attached import attached
from executive.missions import load
from executive.missions.check import check
from executive.runs import mission_assignment
from robot.bringup.mailbox import Handle


def run(options: Run, handle: Handle | None = None) -> int:
    """Check a mission whole, then run it; returns the exit status.

    Its files are kept in the run's folder: an executive that is started again, and a replay, go on
    with what was begun, whatever has become of the files.

    Raises:
        RobotError: something in the file is wrong (ConfigError), or a part does not start.
    """

    def prepare() -> Prepared:
        given = said(options, vary_seed=options.vary_seed)
        path = load.find(options.file)
        checked = check(
            path,
            REALITY.under(options.reality, eyes=options.eyes),
            given,
        )
        say_notes(checked)
        folder = folder_for(options.run_dir, checked.mission.record.name, handle)
        mission_assignment.keep(checked, folder)
        return Prepared(
            assignment=mission_assignment.assignment(checked, given, path=str(path)),
            setup=carrying_out.setup(checked.where, options, folder, handle=handle),
        )

    return carrying_out.carry_out(prepare, options, handle, page=options, attend=attached)


in_executive = from_plain_options(Run, run)
