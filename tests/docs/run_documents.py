#!/usr/bin/env python3
"""run_documents.py SOURCE PROGRAM FOLDER [DOCUMENT...]: does what README and docs say, each in a new folder of a person
without settings, from its first block to its last:

- `sh`: the commands must succeed; a line that ends with "# exits with N" must end so. Windows open without a display, and
  `bench` measures little.
- `text` below it: what the commands print holds these lines, in this order. With a comment above it is no such output.
- "<!-- file: NAME -->" above a block: a file of this name with these lines is there before the first command.
- `json` that is a scene or a case is read by the program; any other must be JSON, or the middle of an object.

Exits with 77 where there is no OpenGL."""

import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys

from documents import all_documents, source_and_rest

SUBCOMMANDS = "conflicts convert diff fit graph info map merge query render simulate sweep test verify"

# Where a person sees the window, a script waits for its first frames.
WRAPPER = """#!/usr/bin/env bash
for argument in "$@"; do [ "$argument" != --script ] || exec {program} "$@"; done
[ "${{1:-}}" != bench ] || exec {program} "$@" --queries 200 --rounds 1
case " {subcommands} -h --help --version " in *" ${{1:-none}} "*) exec {program} "$@" ;; esac
exec {program} "$@" --script {script} --headless
"""

PRELUDE = """set -euo pipefail
exits() { local expected=$1 status=0; shift; "$@" || status=$?
  [ "$status" -eq "$expected" ] || { echo "exits with $status: $*" >&2; return 1; }; }
"""

# What documents call files and folders of their reader's own.
FIXTURES = {
    "walk.csv": "assets/scenes/walk.csv",
    "00_tracks.csv": "tests/docs/fixtures/00_tracks.csv",
    "drones.txt": "fuzz/seeds/text-tracks/drones.txt",
    "clips/stand.glb": "assets/clips/stand.glb",
    "clips/circle.glb": "assets/clips/circle.glb",
    "recordings/wander.glb": "assets/clips/wander.glb",
    "more.bvh": "walk.bvh",
    "short/bend.glb": "assets/clips/bend.glb",
    "long/circle.glb": "assets/clips/circle.glb",
}


class Failed(Exception):
    pass


def fixtures(source, program, folder):
    """What all documents find in their folder."""
    folder.mkdir(parents=True)
    subprocess.run([program, "convert", source / "assets/clips/walk.glb", "-o", folder / "walk.bvh"], check=True,
                   stdout=subprocess.DEVNULL)
    for name, origin in FIXTURES.items():
        target = folder / name
        target.parent.mkdir(exist_ok=True)
        here = folder / origin
        shutil.copyfile(here if here.exists() else source / origin, target)


def with_exits(lines):
    """Lines of commands; one that ends with "# exits with N" must exit so."""
    for line in lines:
        command, mark, status = line.rpartition("# exits with ")
        yield f"exits {status} {command.rstrip()}" if mark else line


class Reader:
    """Somebody who does what one document says."""

    def __init__(self, document, source, program, folder, everybody):
        self.document, self.source, self.folder = document, source, folder
        self.work = folder / "work"
        shutil.copytree(everybody, self.work)
        for name in ("assets", "tests/goldens"):
            shutil.copytree(source / name, self.work / name)
        for name in ("home", "bin"):
            (folder / name).mkdir()
        wrapper = folder / "bin/mobbscope"
        (folder / "no.script").write_text("wait 0.1\n")
        wrapper.write_text(WRAPPER.format(program=program, subcommands=SUBCOMMANDS, script=folder / "no.script"))
        wrapper.chmod(0o755)
        # Sanitizers keep what they were told.
        self.environment = {key: os.environ[key] for key in ("ASAN_OPTIONS", "UBSAN_OPTIONS") if key in os.environ}
        self.environment |= {"PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "HOME": str(folder / "home")}

    def run(self, text):
        """Standard output and error of commands, and their exit status."""
        done = subprocess.run(["bash", "-c", PRELUDE + text], cwd=self.work, env=self.environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
        return done.stdout, done.returncode

    def expect(self, condition, block, why):
        if not condition:
            raise Failed(f"{self.document.path.relative_to(self.source)}:{block.line}: {why}")

    def read(self):
        for block in self.document.blocks:
            if block.file:
                (self.work / block.file).parent.mkdir(parents=True, exist_ok=True)
                (self.work / block.file).write_text(block.text)
        printed = ""
        for block in self.document.blocks:
            if block.language == "sh" and block.not_run is None:
                printed, status = self.run("\n".join(with_exits(block.lines)))
                self.expect(status == 0, block, f"exit status {status}\n{printed}")
            elif block.language == "text" and not block.comment:
                rest = printed
                for line in block.lines:
                    self.expect(line in rest, block, f"the commands above do not print {line!r}, but\n{printed}")
                    rest = rest[rest.index(line) + len(line):]
        for block in self.document.blocks:
            if block.language == "json":
                self.parse(block)

    def parse(self, block):
        whole = block.text.startswith("{")
        try:
            value = json.loads(block.text if whole else "{" + block.text + "}")
        except json.JSONDecodeError as error:
            raise Failed(f"{self.document.path.relative_to(self.source)}:{block.line}: {error}") from error
        if not whole or not {"clips", "mobbscope_case"} & value.keys():
            return
        name = self.work / (block.file or "block.json")
        name.write_text(block.text)
        if "clips" in value:
            printed, status = self.run(f"mobbscope fit '{name}'")
        else:
            printed, status = self.run(f"mobbscope test '{name.parent}' --update '{name.name.removesuffix('.case.json')}'")
        self.expect(status == 0, block, printed)


def main(arguments):
    source, (program, folder, *names) = source_and_rest(arguments)
    program, folder = pathlib.Path(program).resolve(), pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    everybody = folder / "fixtures"
    fixtures(source, program, everybody)
    drawn = subprocess.run([program, "render", source / "assets/scenes/walk.csv", "--size", "64x64", "-o", folder / "probe.png"],
                           check=False)
    if drawn.returncode == 3:
        return 77
    documents = [document for document in all_documents(source)
                 if str(document.path.relative_to(source)) in names or
                 (not names and document.path.parent in (source, source / "docs"))]

    def read(document):
        name = str(document.path.relative_to(source)).replace("/", ".")
        Reader(document, source, program, folder / name, everybody).read()

    faults = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for reading in [pool.submit(read, document) for document in documents]:
            try:
                reading.result()
            except Failed as fault:
                faults.append(str(fault))
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main(sys.argv[1:]))
