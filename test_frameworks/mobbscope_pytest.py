"""Picture tests in pytest: the fixtures `picture` and `answers`.

    def test_crossing(picture):
        picture(scene, "crossing", view={"query": 0}, size="640x360")

`scene`: the path of a scene or clip file, the text of a scene, or a dict. Keywords are further keys of the case, as in
docs/picture_tests.md. `answers` holds the answers to the scene's queries, and no picture. In one run a name is for one
scene with one set of keys.

The goldens are in the folder `goldens` beside the test's file, or in that of --mobbscope-goldens. `mobbscope` draws, in
one process for the whole session: that of the environment variable MOBBSCOPE_PROGRAM, the one installed beside this
file, or the one in PATH. What does not pass is drawn into `mobbscope-test` of the root folder, or into that of
MOBBSCOPE_OUTPUT.
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import types
from pathlib import Path

import pytest

_INSTALLED = Path(__file__).resolve().parents[3] / "bin" / "mobbscope"


def pytest_addoption(parser):
    group = parser.getgroup("mobbscope", "picture tests")
    group.addoption("--mobbscope-goldens", metavar="DIR",
                    help="the folder of the goldens; default: goldens beside each test's file")
    group.addoption("--mobbscope-update", metavar="NAME", action="append", default=[],
                    help="take what is drawn for this case as its golden; 'all': of those that do not pass")


class _Failed(pytest.fail.Exception):
    """What was said of a case that has not passed."""


class _Words:
    """A failure as pytest prints it: whole, and in its summary the reason alone."""

    def __init__(self, text, path):
        self.text = text
        first, _, rest = text.partition("\n")
        reason = ": ".join(line.strip() for line in (first, rest.partition("\n")[0]) if line.strip())
        self.reprcrash = types.SimpleNamespace(path=path, lineno=0, message=reason)

    def __str__(self):
        return self.text

    def toterminal(self, terminal):
        terminal.line(self.text)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    report = (yield).get_result()
    if call.excinfo is not None and isinstance(call.excinfo.value, _Failed):
        report.longrepr = _Words(str(call.excinfo.value), str(item.path))


class _Child:
    """`mobbscope test DIR --asked` at work: it watches over the process that draws, so it answers whatever happens."""

    def __init__(self, goldens, output, update):
        self.goldens, self.output, self.update = goldens, output, update
        self.process = None
        self.asked, self.wrote = set(), []

    def start(self):
        program = os.environ.get("MOBBSCOPE_PROGRAM") or (str(_INSTALLED) if _INSTALLED.exists() else "mobbscope")
        if not shutil.which(program):
            raise _Failed(f"there is no program {program}; install Mobbscope, or name it in MOBBSCOPE_PROGRAM",
                          pytrace=False)
        words = [program, "test", "--asked", "--output", str(self.output)]
        if backend := os.environ.get("MOBBSCOPE_BACKEND"):
            words += ["--backend", backend]
        if self.update:
            words += ["--update", *self.update]
        self.complaints = tempfile.TemporaryFile()
        # In a session of its own: Ctrl+C is for pytest, and this one writes its report then.
        self.process = subprocess.Popen([*words, "--", str(self.goldens)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=self.complaints, start_new_session=True)

    def ask(self, request):
        """The outcome, and the lines that were said of it."""
        if not self.process:
            self.start()
        name, line = request["name"], json.dumps(request).encode() + b"\n"
        self.asked.add(name)
        try:
            lines = self.exchange(line)
        except BaseException:
            # Interrupted. The answer that is still to come would be taken for that of the next case.
            self.process.kill()
            self.end()
            raise
        if lines is None:
            return "failed", [f"mobbscope ended before it answered: {self.end()}"]
        first, *rest = lines or [""]
        if not first.endswith(f" {name}"):
            # What it would answer next is not known either.
            self.end()
            return "failed", [f"mobbscope answered {first!r} when asked for {name!r}", *rest]
        return first.removesuffix(f" {name}"), rest

    def exchange(self, request):
        """The lines of the answer; None: it ended."""
        lines = []
        try:
            self.process.stdin.write(request)
            self.process.stdin.flush()
            while line := self.process.stdout.readline():
                if line == b"\n":
                    return lines
                lines.append(line.decode(errors="replace").removesuffix("\n"))
        except OSError:
            pass
        return None

    def end(self):
        if not self.process:
            return ""
        process, self.process = self.process, None
        try:
            process.stdin.close()
        except OSError:
            pass
        try:
            status = process.wait(30)
        except subprocess.TimeoutExpired:
            process.kill()
            status = process.wait()
        process.stdout.close()
        with self.complaints as said:
            said.seek(0)
            return f"exit status {status}\n" + said.read().decode(errors="replace").strip()


_children = pytest.StashKey()


def pytest_configure(config):
    config.stash[_children] = {}


def pytest_unconfigure(config):
    for child in config.stash.get(_children, {}).values():
        child.end()


def pytest_terminal_summary(terminalreporter, config):
    """What was written, and names of which no test took anything."""
    children = config.stash[_children].values()
    lines = [line for child in children for line in child.wrote]
    asked = set().union(*(child.asked for child in children))
    for name in _updates(config):
        pattern = re.escape(name).replace(r"\*", ".*").replace(r"\?", ".")
        if children and name != "all" and not any(re.fullmatch(pattern, one) for one in asked):
            lines.append(f"no test has asked for {name}, which was to be updated")
    if lines:
        terminalreporter.section("Mobbscope")
        terminalreporter.write("\n".join(lines) + "\n")


def _updates(config):
    given = config.getoption("--mobbscope-update") or [os.environ.get("MOBBSCOPE_UPDATE", "")]
    names = [name for word in given for name in word.split(",") if name]
    return ["all"] if {"all", "1"} & set(names) else names


def _scene_text(scene):
    if isinstance(scene, dict):
        return json.dumps(scene)
    if isinstance(scene, str) and scene.lstrip().startswith("{"):
        return scene
    return str(Path(scene).absolute())


def _checker(request, fixed):
    config = request.config
    root, children = Path(config.rootpath), config.stash[_children]
    goldens = config.getoption("--mobbscope-goldens")
    folder = Path(config.invocation_params.dir, goldens) if goldens else request.path.parent / "goldens"
    if folder not in children:
        output = Path(os.environ.get("MOBBSCOPE_OUTPUT") or root / "mobbscope-test")
        # Folders of goldens may have cases of one name.
        below = folder.relative_to(root) if folder.is_relative_to(root) else folder.name
        children[folder] = _Child(folder, output / below, _updates(config))
    child = children[folder]

    def check(scene, name, **keys):
        __tracebackhide__ = True
        outcome, lines = child.ask({"name": name, "scene": _scene_text(scene), "keys": json.dumps({**fixed, **keys})})
        if outcome == "passed":
            child.wrote += lines
        elif outcome == "skipped":
            pytest.skip("\n".join(lines))
        else:
            raise _Failed("\n".join(lines), pytrace=False)

    return check


@pytest.fixture
def picture(request):
    """picture(scene, name, **keys): draws the scene, and fails unless it is the golden of that name."""
    return _checker(request, {})


@pytest.fixture
def answers(request):
    """answers(scene, name, **keys): fails unless the answers to the scene's queries are the golden's."""
    return _checker(request, {"hold": ["answers"]})
