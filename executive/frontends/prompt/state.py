"""What the robot knows of itself when it is spoken to: its state, with the jobs it has."""

from __future__ import annotations

from msgspec.structs import replace

from executive.blackboard import NOW, PAUSE
from executive.engine.executive import Executive
from executive.engine.jobs import OVER, UNDER_WAY, Job
from executive.frontends.prompt.robot import CRIED
from executive.journal import failures
from executive.meaning.knowledge import Knowledge
from executive.meaning.robot_state import state_of
from executive.meaning.tasks import SKILLS
from intents.relations import Viewpoint
from intents.state import RobotState
from robot.files.misfits import listed
from robot.link import BodyLink


def robot_state(executive: Executive, link: BodyLink, knowledge: Knowledge) -> RobotState:
    """A snapshot for one turn of a conversation."""
    jobs = executive.jobs
    under_way = [job for job in jobs if job.state in UNDER_WAY]
    over = [job for job in jobs if job.state in OVER]
    power, help_ = link.power(), executive.question
    state = state_of(executive.board, knowledge, skills=SKILLS)
    unwell = [finding.failure.cause for finding in executive.health.findings]
    start = knowledge.map.start_X_WS
    x_m, y_m, _ = start.p
    return replace(
        state,
        # before the first tick nothing is known yet of where it stands but that
        view=state.view or Viewpoint(x_m=x_m, y_m=y_m, yaw_rad=start.yaw_rad),
        doing=under_way[0].text if under_way else "",
        worked_s=_worked_s(under_way[0], executive.board.read(NOW)) if under_way else None,
        step=state.step if under_way else "",
        waiting=tuple(job.text for job in jobs if job.state == "waiting"),
        mode={"pausing": "paused", "stopping": "stopped"}.get(executive.state, executive.state),
        holds=_holds(executive, under_way[0].text if under_way else ""),
        problems=(*unwell, *([f"I need help, {help_}"] if help_ else [])),
        battery=power.charge if power else None,
        last=_ending(over[-1]) if over else "",
        did=over[-1].text if over else "",
    )


def _worked_s(job: Job, now_s: float) -> float | None:
    return None if job.began_s is None else now_s - job.began_s


def _holds(executive: Executive, doing: str) -> str:
    """Why it stands with something to do, or with its emergency stop on; empty if it does not."""
    if executive.estop.latched:
        return f"The emergency stop is on: {executive.estop.why}."
    about = f" at “{doing}”" if doing else ""
    why = executive.board.read(PAUSE)
    if why == CRIED:
        return f"I halted{about} because you called out; say whether I shall go on."
    if why:
        return f"I have paused{about}: {why}. “Resume” lets me go on."
    if executive.held and executive.state == "paused":
        return f"A breakpoint holds {listed(executive.held)}{about}: `continue` lets it go."
    return ""


def _ending(job: Job) -> str:
    """How a job ended, in the robot's words."""
    if job.failure is None:
        return f"I have done “{job.text}”."
    stopped = job.state == "cancelled"
    return failures.in_first_person(f"“{job.text}”", job.failure.cause, stopped=stopped)
