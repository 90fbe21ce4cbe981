"""The page, put together from its parts: one answer to one request, which needs no other."""

from __future__ import annotations

import base64
import hashlib
from importlib import resources
from string import Template

SCRIPTS = (
    "1_maths.js", "2_shapes.js", "3_drawing.js", "3_marks.js", "4_moving.js", "4_sensing.js",
    "5_panels.js", "5_plans.js", "5_camera.js", "5_motors.js", "5_faults.js",
    "5_microphone.js", "6_link.js", "7_main.js",
)  # fmt: skip


def page() -> tuple[bytes, str]:
    """The page, and the policy that it is served with: its own script and style, and no others.

    It may speak to the server that it came from, and to nobody else.
    """
    files = resources.files("executive.frontends.console") / "page"
    script = "\n".join((files / name).read_text(encoding="utf-8") for name in SCRIPTS)
    style = (files / "console.css").read_text(encoding="utf-8")
    template = Template((files / "page.html").read_text(encoding="utf-8"))
    policy = (
        f"default-src 'none'; script-src {_hash(script)}; style-src {_hash(style)}; "
        "connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    )
    return template.substitute(style=style, script=script).encode(), policy


def _hash(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
