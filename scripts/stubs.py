"""Writes type stubs of mujoco's compiled modules to .venv/typings, for the type checker.

MuJoCo ships none. Its bindings carry full signatures in their docstrings, from which
pybind11-stubgen reads them: what is written fits the installed version, and is not kept in git.
"""

import re
import subprocess
import sys
from pathlib import Path

PARTS = ("callbacks", "constants", "enums", "errors", "functions", "render", "specs", "structs")
BARE = {
    "list": "list[typing.Any]",
    "dict": "dict[typing.Any, typing.Any]",
    "tuple": "tuple[typing.Any, ...]",
}
OUTPUT = Path(__file__).resolve().parent.parent / ".venv" / "typings"


def repair(stub: str) -> str:
    """Says what the docstrings leave open: C++ names, views made at run time, bare containers."""
    elements = {name.lower(): f"Mjs{name}" for name in re.findall(r"^class Mjs(\w+):", stub, re.M)}

    def typed_list(found: re.Match[str]) -> str:
        plural = found[1]
        singulars = (plural[:-1], plural[:-2], plural[:-3] + "y")
        element = next((elements[one] for one in singulars if one in elements), "typing.Any")
        return f"def {plural}(self) -> list[{element}]:"

    stub = re.sub(r"-> \.\.\.:", "-> typing.Any:", stub)
    stub = re.sub(r"\bmjs([A-Z]\w*)_\b", r"mujoco._specs.Mjs\1", stub)
    stub = re.sub(r"def (\w+)\(self\) -> list:", typed_list, stub)
    for container, full in BARE.items():
        stub = re.sub(rf"(?<=[:>|] ){container}(?=[\s,):|=])", full, stub)
    return stub


def main() -> None:
    """Generates, repairs, and joins the parts as the package `mujoco`."""
    stubgen = [sys.executable, "-m", "pybind11_stubgen", "--output-dir", str(OUTPUT)]
    for part in PARTS:
        done = subprocess.run(
            [*stubgen, f"mujoco._{part}"], capture_output=True, text=True, check=False
        )
        if done.returncode:
            sys.exit(f"error: no stub of mujoco._{part}\n{done.stderr}")
        path = OUTPUT / "mujoco" / f"_{part}.pyi"
        path.write_text(repair(path.read_text()))
    lines = [f"from mujoco._{part} import *" for part in PARTS]
    lines += [
        "from mujoco.rendering.classic.gl_context import *",
        "from mujoco.rendering.classic.renderer import Renderer as Renderer",
        "__version__: str",
    ]
    (OUTPUT / "mujoco" / "__init__.pyi").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
