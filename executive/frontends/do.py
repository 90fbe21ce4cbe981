"""`humanoid do`: what a sentence means, asking back where that is open, and doing it."""

from __future__ import annotations

import sys
from dataclasses import replace

from executive.frontends import carrying_out, output, speaking
from executive.frontends.carrying_out import Prepared
from executive.frontends.composition_root import REALITY
from executive.frontends.exit import refuse
from executive.frontends.language_model import language_model
from executive.frontends.launching import folder_for, from_plain_options
from executive.frontends.options import Do
from executive.frontends.output import say
from executive.frontends.prompt.attached import attached
from executive.meaning import request
from executive.runs.task_run import Assignment
from intents.outcomes import Question
from intents.plans import numbered
from intents.risks import risk
from robot.bringup.mailbox import Handle


def do(options: Do, handle: Handle | None = None) -> int:
    """Understand, check, and only then start a robot and do it; returns the exit status.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    aloud = speaking.able(wanted=options.aloud, model=options.voice_model)
    options = replace(options, voice=aloud)

    def prepare() -> Prepared | int:
        where = request.setting(
            REALITY.under(options.reality, eyes=options.eyes),
            options.world,
            robot=options.robot,
            vary_seed=options.vary_seed,
        )
        understood = _understood(options, where)
        if isinstance(understood, request.Refused):
            return refuse(understood, as_json=options.as_json)
        if understood.remark:
            told = f"  {understood.remark}"
            say(told, err=options.as_json, styled=(told, "dim"))
        folder = folder_for(options.run_dir, options.text, handle)
        setup = carrying_out.setup(where, options, folder, handle=handle)
        return Prepared(assignment=Assignment(understood=understood), setup=setup)

    return carrying_out.carry_out(
        prepare, options, handle, voiced=options, page=options, attend=attached
    )


in_executive = from_plain_options(Do, do)


def _understood(options: Do, where: request.Setting) -> request.Understood | request.Refused:
    """What the sentence means here; who is at the terminal is asked back, aloud where wanted."""
    asking = at_terminal() and not options.as_json
    model = language_model(options.model)
    if model is not None:
        model.unable = lambda goals: request.unable(goals, where)
    with speaking.opened(wanted=options.aloud, model=options.voice_model) as speech:

        def aloud(question: Question) -> str | None:
            if options.yes and _is_harmless_plan(question):
                say(f"I shall do this:\n{numbered(question.goals)}", err=options.as_json)
                return "yes"
            if not asking:
                return None
            speech.say(question.question)
            answer = ask(question)
            speech.hush()
            return answer

        meant = request.request(options.text, where, ask=aloud, fallback=model)
        if isinstance(meant, request.Refused):
            if model is not None and model.trouble:
                say(f"The language model was of no help: {model.trouble}.", err=True)
            if not asking or meant.outcome != "question":
                speech.say(meant.reason)
                speech.finish()
    return meant


def _is_harmless_plan(question: Question) -> bool:
    """Whether it is asked only because a language model has made it."""
    made = question.parser == "model" and question.kind == "confirmation"
    return made and not risk(question.goals)


def at_terminal() -> bool:
    """Whether somebody can be asked."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def ask(question: Question) -> str | None:
    """Put an open question to the person at the terminal."""
    try:
        answer = output.ask(question.question)
    except (KeyboardInterrupt, EOFError):
        say()  # what is said next begins a line
        return None
    return answer or None
