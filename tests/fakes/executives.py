"""The executives of a live run, as processes that a test can find and kill."""

from pathlib import Path


def executives(job: int, module: str = "executive.main") -> list[int]:
    """Process ids of a job's executives, run as `module`: the one at work, then the spare."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if module.encode() in words and str(job).encode() in words:
            found.append((int(words[-2]), int(entry.name)))
    return [pid for _, pid in sorted(found)]
