"""A failure code: the ground is too slippery to walk on.

`KIND` would be the row "slipping" of `CATALOGUE` in `robot/failures.py`, `RULE` that of `RULES` in
`executive/trees/recovery.py`. The rule asks a person when all else has failed, so there is a third
row, `HELP` in `executive/trees/remedies.py`; a rule without `ask` needs two files.
"""

from __future__ import annotations

from executive.trees.recovery import Rule
from robot.failures import FailureKind

CODE = "slipping"
# Another cup may stand where the floor is dry, so that it spoils what is done with one thing.
KIND = FailureKind("the feet slip on the floor", "dry the floor", spoils="thing")
# Another try plans other footsteps; a step back leads to where it has just stood safely.
RULE = Rule((("retry", 1), ("step_back", 1), ("ask", 1)))
WISH = "please dry the floor before me"
