"""Whatever is written, no terminal obeys a stranger's text; and nothing is written elsewhere."""

import ast
import io
import json
import threading
import warnings
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len
from rich.control import strip_control_codes
from rich.progress import Progress, TextColumn
from rich.table import Table
from rich.text import Text

from executive.frontends import cli, output, parse
from robot.clock import SimulatedClock
from robot.errors import ConfigError
from robot.printable import is_printable, printable

ROOT = Path(__file__).parents[4]
HOSTILE = (
    "\x1b]0;title\x07cup", "\x1b]52;c;aGk=\x1b\\", "\x1b[2J\x1b[1;1H", "\x9b31mred", "\x9d0;t\x9c",
    "a\rb", "a\x08b", "cup\u202egnp", "\u2066x\u2069", "a\u2028b", "\x7f", "\x00", "\x0e",
    "[red]name[/red]", "[/]", "[link=file:///etc/passwd]x[/link]", "[@click=x]y[/]", ":smiley:",
)  # fmt: skip
ANY = st.text(st.one_of(st.characters(), st.sampled_from("\x1b\x9b\x07]0;[]m \n")), max_size=60)


@pytest.fixture
def terminal(monkeypatch):
    """Standard output as a terminal with colours, and what it was sent."""

    class Terminal(io.StringIO):
        encoding = "utf-8"

        def isatty(self) -> bool:
            return True

    def opened(columns: int = 80) -> Terminal:
        screen = Terminal()
        monkeypatch.setattr("sys.stdout", screen)
        for name, value in {"TERM": "xterm-256color", "COLUMNS": str(columns)}.items():
            monkeypatch.setenv(name, value)
        monkeypatch.delenv("NO_COLOR", raising=False)
        return screen

    return opened


def obeyed(sent: str, own: tuple[str, ...] = ()) -> str:
    """What a terminal would obey of what it was sent, but for what is our own."""
    for one in own:
        sent = sent.replace(one, "")
    return "".join(one for one in sent if not is_printable(one))


def drawn(name: str) -> str:
    """How rich shows a name: it leaves some control characters out by itself."""
    return printable(strip_control_codes(name))


@pytest.mark.parametrize("name", HOSTILE)
def test_a_line_is_shown_and_not_obeyed(name, terminal, capsys):
    output.say(f"the {name}", err=True)
    assert capsys.readouterr().err == f"the {printable(name)}\n"
    screen = terminal(200)
    output.say(f"the {name}")
    assert screen.getvalue() == f"the {printable(name)}\n"


@pytest.mark.parametrize("name", HOSTILE)
def test_a_screen_keeps_its_own_styles_and_shows_a_name_as_it_is(name, terminal):
    screen = terminal(200)
    output.Screen().print(Text(f"<{name}>", style="red"))
    assert screen.getvalue() == f"\x1b[31m<{drawn(name)}>\x1b[0m\n"


@pytest.mark.parametrize("name", HOSTILE)
def test_whatever_rich_draws_a_name_is_only_text(name, terminal):
    screen = terminal(200)
    console = output.Screen()
    table = Table(name, title=name, box=None)
    table.add_row(name)
    console.print(table)
    console.print(name)
    with Progress(TextColumn("{task.description}", markup=False), console=console) as bar:
        bar.add_task(name, total=1)
    assert screen.getvalue().count(drawn(printable(name))) >= 3
    own = ("\x1b[?25l", "\x1b[?25h", "\x1b[2K", "\x1b[1A", "\r")
    styles = ("\x1b[0m", "\x1b[1m", "\x1b[3m")
    assert not obeyed(screen.getvalue(), own + styles)


@given(ANY)
def test_json_means_the_same_and_commands_nothing(text):
    written = io.StringIO()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.stdout", written)
        readable = text.encode(errors="replace").decode()
        output.write_json({readable: [readable]})
    line = written.getvalue()
    assert is_printable(line)
    assert line.count("\n") == 1
    assert json.loads(line) == {readable: [readable]}


def test_what_is_asked_is_shown_and_not_obeyed(monkeypatch):
    monkeypatch.setattr("builtins.input", lambda prompt: prompt)
    assert output.ask("the \x1b[2Jcup?") == "the \\x1b[2Jcup? "


@given(ANY, st.integers(10, 100))
def test_lines_are_broken_between_words_only(text, columns):
    made = output.fitted(printable(text), columns)
    assert made.split() == printable(text).split()
    for line in made.split("\n"):
        assert cell_len(line) <= columns or len(line.split()) == 1 or "\t" in line


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("one two three four", "one two three\nfour"),
        ("  one two three", "  one two\n  three"),
        ("ab  one two three", "ab  one two\n    three"),
        ("[ 1 s] one four", "[ 1 s] one\n       four"),
        ("see /a/very/long/path/that/is/copied", "see\n/a/very/long/path/that/is/copied"),
        ("short\n\nlines", "short\n\nlines"),
    ],
)
def test_a_line_goes_on_below_what_it_began_beside(text, shown):
    assert output.fitted(text, 14) == shown


def test_a_terminal_gets_lines_that_fit_and_a_pipe_gets_them_whole(terminal, capsys):
    long = "word " * 40
    output.say(long.strip())
    assert capsys.readouterr().out == long.strip() + "\n"
    screen = terminal(60)
    output.say(long.strip())
    assert max(map(len, screen.getvalue().splitlines())) <= 60


def test_what_python_writes_by_itself_is_written_here_too(monkeypatch, capsys):
    for name in ("sys.excepthook", "threading.excepthook", "warnings.showwarning"):
        monkeypatch.setattr(name, None)
    monkeypatch.setattr("logging.lastResort", None)
    output.tell_of_mistakes()

    def fail() -> None:
        raise ValueError("\x1b[2J")

    thread = threading.Thread(target=fail)
    thread.start()
    thread.join()
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        warnings.warn("\x1b]0;x\x07", stacklevel=1)
    told = capsys.readouterr().err
    assert "ValueError: \\x1b[2J" in told
    assert "warning: \\x1b]0;x\\x07" in told
    assert is_printable(told)


@pytest.mark.parametrize("name", HOSTILE[:13])
def test_words_of_the_command_line_that_cannot_be_printed_are_refused(name, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["humanoid", "do", "--nosuch", name])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    told = capsys.readouterr()
    assert "cannot be printed" in told.err
    assert is_printable(told.err + told.out)


@pytest.mark.parametrize("name", HOSTILE[:13])
@pytest.mark.parametrize(
    "form",
    [
        lambda name: {"objects": [name]},
        lambda name: {"objects": [{"name": "cup", "synonyms": [name]}]},
        lambda name: {"people": [name]},
        lambda name: {"categories": {"cup": name}},
    ],
)
def test_names_of_a_vocabulary_that_cannot_be_printed_are_refused(name, form, tmp_path):
    file = tmp_path / "names.json"
    file.write_text(json.dumps(form(name)))
    with pytest.raises(ConfigError, match="cannot be printed"):
        parse.parse_all(["stop"], world="", vocabulary=file, file=None, as_json=False)


# --- nobody else writes ---

OWN = {
    "executive/__main__.py",  # what it says, where no other module can be loaded
    "executive/frontends/console/ears.py",  # a process that answers its parent through a pipe
    "executive/frontends/output.py",
    "executive/frontends/streams.py",
    "executive/runs/lidar_maps/kept.py",  # that a map is made first, made fit for a terminal there
    "robot/model/trial.py",  # a process that answers its parent through a pipe
}
CALLS = {"print", "typer.echo", "typer.secho", "typer.prompt", "typer.confirm", "click.echo",
         "click.secho", "click.prompt", "input", "print_formatted_text", "traceback.print_exc",
         "traceback.print_exception", "traceback.print_stack", "Console", "sys.excepthook",
         "sys.__stdout__.write", "sys.__stderr__.write"}  # fmt: skip
MODULES = {"rich.console.Console", "rich.print", "rich.prompt", "rich.get_console", "click",
           "rich.traceback", "rich.logging", "rich.markup", "rich.pretty"}  # fmt: skip
QUESTIONS = {"isatty", "fileno", "encoding"}
"""What may be asked of a standard stream; the rest is writing."""


def written_by(tree: ast.AST) -> list[str]:
    """Where a module writes by itself."""
    found: list[str] = []
    asked = {
        id(node.value) for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and node.attr in QUESTIONS
    }  # fmt: skip
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func) in CALLS:
            found.append(f"{node.lineno}: {ast.unparse(node.func)}")
        if isinstance(node, ast.Attribute) and id(node) not in asked:
            text = ast.unparse(node)
            if text in ("sys.stdout", "sys.stderr", "sys.__stdout__", "sys.__stderr__"):
                found.append(f"{node.lineno}: {text}")
        if isinstance(node, ast.ImportFrom):
            names = {f"{node.module}.{alias.name}" for alias in node.names} | {str(node.module)}
            found += [f"{node.lineno}: {name}" for name in sorted(names & MODULES)]
        if isinstance(node, ast.Import):
            found += [f"{node.lineno}: {a.name}" for a in node.names if a.name in MODULES]
    return found


def modules():
    """Every module of the four packages."""
    for package in ("executive", "intents", "robot", "sim"):
        yield from sorted((ROOT / package).rglob("*.py"))


def test_nobody_else_writes():
    found = {
        str(path.relative_to(ROOT)): written
        for path in modules()
        if (written := written_by(ast.parse(path.read_text(encoding="utf-8"))))
    }
    assert set(found) <= OWN, found


@pytest.mark.parametrize(
    "code",
    [
        "print(1)", "import sys\nsys.stdout.write('x')", "import sys\nsys.stderr.flush()",
        "import typer\ntyper.echo('x')", "from rich.console import Console",
        "import click", "import sys\nx = sys.stdout", "import traceback\ntraceback.print_exc()",
    ],
)  # fmt: skip
def test_writing_is_seen(code):
    assert written_by(ast.parse(code))


def test_who_waits_where_no_bar_is_drawn_is_told_once_for_what(capsys):
    clock = SimulatedClock()
    waiting = output.Waiting("starting the robot", clock=clock)
    waiting.look()
    clock.set(0.9 * output.SILENT_S)
    waiting.look()
    assert capsys.readouterr() == ("", "")
    for t_s in (1.1 * output.SILENT_S, 10.0):
        clock.set(t_s)
        waiting.look()
    assert capsys.readouterr() == ("", "starting the robot ...\n")


def test_who_gives_an_option_of_the_prompt_to_no_command_is_told_where_it_belongs(
    monkeypatch, capsys
):
    monkeypatch.setattr("sys.argv", ["humanoid", "--view"])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    assert "humanoid repl --view" in capsys.readouterr().err
