"""What is done in the process of a case before it begins: limits, signals, rights."""

import ctypes
import os
import resource
import signal
from pathlib import Path


def files(count: int) -> None:
    resource.setrlimit(resource.RLIMIT_NOFILE, (count, count))


def size(count: int) -> None:
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # half of it is taken for the whole by others
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (count, count))


def processes(count: int) -> None:
    resource.setrlimit(resource.RLIMIT_NPROC, (count, count))


def mask() -> None:
    os.umask(0o777)


def read_only() -> None:
    Path("runs").mkdir(exist_ok=True)
    Path("runs").chmod(0o555)
    Path().chmod(0o555)


def sealed(name: str) -> None:
    """Done by the user himself: nobody may read that file of the run, or write into its folder."""
    run = Path("runs") / "short"
    if name == "no access":
        run.chmod(0)
    else:
        (run / name).chmod(0o555 if name == "." else 0)


def folder_gone() -> None:
    here = Path.cwd() / "gone"
    here.mkdir()
    os.chdir(here)
    here.rmdir()


def ignores_signals() -> None:
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGCHLD):
        signal.signal(number, signal.SIG_IGN)


def full_shm(options: str) -> None:
    """A /dev/shm of its own that others have filled, in a namespace of mounts of its own."""
    if ctypes.CDLL(None, use_errno=True).mount(b"none", b"/dev/shm", b"tmpfs", 0, options.encode()):
        raise OSError(ctypes.get_errno(), "no /dev/shm of its own")
    try:
        for number in range(1000):
            (Path("/dev/shm") / f"fill-{number}").write_bytes(bytes(4096))
    except OSError:
        return
