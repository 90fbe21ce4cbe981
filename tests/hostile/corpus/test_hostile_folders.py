"""The current folder is somebody else's: no Python file in it is run, whatever it is called."""

from tests.hostile.cases import Case, Expect
from tests.hostile.exam import exam

NAMES = (
    "msgspec", "multiprocessing", "executive", "robot", "sim", "intents", "numpy", "json",
    "logging", "typing", "mujoco", "zenoh", "py_trees", "site", "sitecustomize", "concurrent",
)  # fmt: skip
PLANTED = {f"{name}.py": 'raise SystemExit("a stranger\'s file was run")\n' for name in NAMES}
COMMANDS = {
    "live": (("walk", "--speed", "0", "--for", "0.1"), ("walked",)),
    "live-plan": (("do", "step forward 0.2 m", "--seed", "1"), ("Done",)),
    "fast": (("do", "squat for one second", "--fast"), ("Done",)),
    "eval": (("eval", "squat for one second", "--seeds", "2"), ("2",)),
    "check": (("mission", "check", "hello"), ()),
    "doctor": (("doctor",), ()),
}
"""Cold: in a process of their own, which loads what it needs from where it stands."""
CASES = [
    Case(
        name=name,
        argv=argv,
        files=dict(PLANTED),
        expect=Expect.ENDS,
        says=says,
        never=("stranger's file",),
        cold=True,
        cpu_s=40,
    )
    for name, (argv, says) in COMMANDS.items()
]

test_folder = exam("folders", CASES)
