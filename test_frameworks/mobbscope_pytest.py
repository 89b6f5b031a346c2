"""Picture tests in pytest: the fixtures `picture` and `answers`.

    def test_crossing(picture):
        picture(scene, "crossing", view={"query": 0}, size="640x360")

`scene`: the path of a scene or clip file, the text of a scene, or a dict. Keywords are further keys of the case, as in
docs/picture_tests.md. `answers` holds the answers to the scene's queries, and no picture.

The goldens are in the folder `goldens` beside the test's file, or in that of --mobbscope-goldens. `mobbscope` draws, in
one process for the whole session: that of the environment variable MOBBSCOPE_PROGRAM, the one installed beside this
file, or the one in PATH. What does not pass is drawn into `mobbscope-test` of the root folder, or into that of
MOBBSCOPE_OUTPUT.
"""

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

_INSTALLED = Path(__file__).resolve().parents[3] / "bin" / "mobbscope"


def pytest_addoption(parser):
    group = parser.getgroup("mobbscope", "picture tests")
    group.addoption("--mobbscope-goldens", metavar="DIR", help="the folder of the goldens; default: goldens beside each test's file")
    group.addoption("--mobbscope-update", metavar="NAME", action="append", default=[],
                    help="take the picture of this case as its golden, whatever differs; 'all': of those that do not pass")


class _Child:
    """`mobbscope test DIR --asked` at work. It watches over the process that draws, and answers whatever a case does."""

    def __init__(self, goldens, output, update):
        self.goldens, self.output, self.update = goldens, output, update
        self.process = None

    def start(self):
        program = os.environ.get("MOBBSCOPE_PROGRAM") or (str(_INSTALLED) if _INSTALLED.exists() else "mobbscope")
        if not shutil.which(program):
            pytest.fail(f"there is no program {program}; install Mobbscope, or name it in MOBBSCOPE_PROGRAM", pytrace=False)
        words = [program, "test", "--asked", "--output", str(self.output)]
        if backend := os.environ.get("MOBBSCOPE_BACKEND"):
            words += ["--backend", backend]
        if self.update:
            words += ["--update", *self.update]
        self.complaints = tempfile.TemporaryFile()
        # In a session of its own, as Ctrl+C is pytest's: it still writes its report.
        self.process = subprocess.Popen([*words, "--", str(self.goldens)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=self.complaints, start_new_session=True)

    def ask(self, request):
        """The outcome and the lines that were said of it; no outcome: it ended."""
        if not self.process:
            self.start()
        lines = []
        try:
            self.process.stdin.write(json.dumps(request).encode() + b"\n")
            self.process.stdin.flush()
            while line := self.process.stdout.readline():
                if line == b"\n":
                    return lines[0], lines[1:]
                lines.append(line.decode(errors="replace").rstrip("\n"))
        except OSError:
            pass
        return "", [f"mobbscope ended before it answered: {self.end()}"]

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


@pytest.fixture(scope="session")
def _mobbscope_children():
    children = {}
    yield children
    for child in children.values():
        child.end()


def _scene_text(scene):
    if isinstance(scene, dict):
        return json.dumps(scene)
    if isinstance(scene, str) and scene.lstrip().startswith("{"):
        return scene
    return str(Path(scene).absolute())


def _checker(request, children, fixed):
    root = Path(request.config.rootpath)
    goldens = request.config.getoption("--mobbscope-goldens")
    folder = Path(request.config.invocation_params.dir, goldens) if goldens else request.path.parent / "goldens"
    update = [name for given in request.config.getoption("--mobbscope-update") for name in given.split(",")]
    if not update and (asked := os.environ.get("MOBBSCOPE_UPDATE")):
        update = asked.split(",")
    update = ["all"] if {"all", "1"} & set(update) else update
    if folder not in children:
        output = Path(os.environ.get("MOBBSCOPE_OUTPUT") or root / "mobbscope-test")
        # Folders of goldens may have cases of one name.
        below = folder.relative_to(root) if folder.is_relative_to(root) else folder.name
        children[folder] = _Child(folder, output / below, update)
    child = children[folder]

    def check(scene, name, **keys):
        __tracebackhide__ = True
        outcome, lines = child.ask({"name": name, "scene": _scene_text(scene), "keys": json.dumps({**fixed, **keys})})
        if outcome == "passed":
            print(*lines, sep="\n", end="\n" if lines else "")
        elif outcome == "skipped":
            pytest.skip("\n".join(lines))
        else:
            pytest.fail("\n".join(lines), pytrace=False)

    return check


@pytest.fixture
def picture(request, _mobbscope_children):
    """picture(scene, name, **keys): draws the scene, and fails unless it is the golden of that name."""
    return _checker(request, _mobbscope_children, {})


@pytest.fixture
def answers(request, _mobbscope_children):
    """answers(scene, name, **keys): fails unless the answers to the scene's queries are the golden's."""
    return _checker(request, _mobbscope_children, {"hold": ["answers"]})
