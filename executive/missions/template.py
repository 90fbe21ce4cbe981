"""What `humanoid mission new` writes: a small mission with a word on everything."""

from __future__ import annotations

TEMPLATE = """\
# yaml-language-server: $schema={schema}
# Check it: humanoid mission check {file}    Run it: humanoid mission run {file} --fast
name: {name}
about: What it is for, in a sentence.
world: kitchen              # a shipped world (humanoid worlds), or a file beside this one

limits:
  duration_s: 600           # the whole mission
  # speed_m_s: 0.25         # walk no faster

parameters:                 # {{{{thing}}}} stands for a value; or: --param thing="blue cup"
  thing: {{type: object, default: red cup}}
  goal: {{type: place, default: table}}

steps:
  - "find the {{{{thing}}}}"    # a step is a sentence in plain English ...
  - bring: {{object: "{{{{thing}}}}", to: "{{{{goal}}}}"}}   # ... or a goal with its slots
    retry: 1                # options of any step: retry, timeout_s, on_fail, always, name
    timeout_s: 300
    on_fail:
      no_path: ["say the way is blocked", fail: "I cannot get there"]
      any: [say: "I could not bring it"]
  - if: "the {{{{thing}}}} is on the {{{{goal}}}}"
    then: [say: "There it is."]
    else: [say: "It is somewhere else."]
  # - repeat: 3               # also: while + at_most, for_each + in, parallel, mission + with
  #   do: ["go to the counter", "go to the table"]

always:                     # done after the steps, however they end
  - say: "I am done."

expect:                     # what has to be so at the end: so a mission is a test as well
  - "the {{{{thing}}}} is on the {{{{goal}}}}"
  - holding: false

# faults:                   # what goes wrong on purpose, in simulation only (docs/recovery.md)
#   - {{fault: push, at_s: 5, impulse_n_s: [0, 4, 0]}}
"""


def template(name: str, *, file: str, schema: str) -> str:
    """The text of a new mission."""
    return TEMPLATE.format(name=name, file=file, schema=schema)
