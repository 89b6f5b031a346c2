"""The Markdown documents of the project: what a first visitor and a contributor read."""

import pathlib
import re


class Block:
    """A fenced block: language, lines, and the HTML comment just above it: "file: NAME", "not run: WHY", or other words."""

    def __init__(self, language, lines, line, comment):
        self.language = language
        self.lines = lines
        self.line = line  # of the opening fence, from 1
        self.comment = comment
        key, _, value = comment.partition(":")
        self.file = value.strip() if key == "file" else None
        self.not_run = value.strip() if key == "not run" else None

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"


class Document:
    def __init__(self, path):
        self.path = path
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.blocks = []
        self.prose = []  # (number from 1, line) outside of blocks
        opened = None
        for number, line in enumerate(self.lines, 1):
            if opened is None and line.startswith("```"):
                opened = number
            elif opened is not None and line == "```":
                above = re.fullmatch(r"<!-- (.*) -->", self.lines[opened - 2]) if opened > 1 else None
                self.blocks.append(Block(self.lines[opened - 1][3:], self.lines[opened:number - 1], opened,
                                         above[1] if above else ""))
                opened = None
            elif opened is None:
                self.prose.append((number, line))
        if opened is not None:
            raise SystemExit(f"{path}:{opened}: the block has no end")

    def anchors(self):
        """What GitHub makes of the headings."""
        out = set()
        for _, line in self.prose:
            heading = re.match(r"#+ +(.*)", line)
            if heading:
                words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).lower()
                anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
                copies = sum(a == anchor or re.fullmatch(re.escape(anchor) + r"-\d+", a) is not None for a in out)
                out.add(f"{anchor}-{copies}" if copies else anchor)
        return out

    def links(self):
        """(line, target) of every link and picture."""
        for number, line in self.prose:
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
                yield number, target


def all_documents(source):
    """README, docs and the READMEs beside the code, in order."""
    paths = [source / "README.md", *sorted((source / "docs").rglob("*.md")), source / "src/README.md",
             source / "examples/README.md", source / "third_party/README.md", source / "assets/figures/README.md"]
    return [Document(path) for path in paths]


def source_and_rest(arguments):
    return pathlib.Path(arguments[0]).resolve(), arguments[1:]
