#!/usr/bin/env python3
"""check_documents.py SOURCE: no link in a document is broken, README stays short, docs/README.md lists all documents in
README's order, C++ and CMake in documents are what tests/install compiles, and few commands are left unrun."""

import re
import sys
import urllib.parse

from documents import all_documents, source_and_rest, Document

LANGUAGES = {"sh", "text", "json", "csv", "cpp", "cmake", "python", "yaml"}
README_LINES = 160
README_PICTURES = 4
NOT_RUN = 14  # blocks of commands, in all documents


def broken_links(document):
    for number, target in document.links():
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        path = document.path.parent / urllib.parse.unquote(name) if name else document.path
        if not path.exists():
            yield f"{number}: there is no {target}"
        elif anchor and path.suffix == ".md" and anchor not in Document(path).anchors():
            yield f"{number}: {name or 'this document'} has no heading #{anchor}"


def uncompiled(document, sources):
    """C++, CMake and Python that are not, line by line, a part of an example that is compiled."""
    for block in document.blocks:
        if block.language in ("cpp", "cmake", "python") and not any("\n" + block.text in "\n" + text for text in sources):
            yield f"{block.line}: is not a part of any file in tests/install"


def bad_blocks(document):
    for block in document.blocks:
        if block.language not in LANGUAGES:
            yield f"{block.line}: a block is one of {', '.join(sorted(LANGUAGES))}, not '{block.language}'"
        if block.not_run is not None and (block.language != "sh" or len(block.not_run) < 10):
            yield f"{block.line}: 'not run' stands above commands, and says why"


def jobs_of_ci(source):
    """Both CI jobs call the program as the walk-through does."""
    call = "mobbscope test pictures --output report/pictures --junit report/junit.xml --html report/index.html"
    if (source / "docs/ci.md").read_text().count(call) != 3:
        yield "docs/ci.md: the walk-through and the two jobs do not make the same call"


def order_of_documents(source):
    """README and docs/README.md name the same documents in the same order, and leave none out."""
    listed = {}
    for name in ("README.md", "docs/README.md"):
        document = Document(source / name)
        paths = [(document.path.parent / target).resolve() for number, target in document.links()
                 if re.match(r"\||\d+\. ", document.lines[number - 1])]
        listed[name] = [path.name for path in paths if path.parent == source / "docs"]
    there = sorted(path.name for path in (source / "docs").glob("*.md") if path.name != "README.md")
    if listed["README.md"] != listed["docs/README.md"]:
        yield "docs/README.md: lists other documents than README, or in another order"
    if sorted(listed["README.md"]) != there:
        yield f"README.md: lists {sorted(listed['README.md'])}, but docs has {there}"


def main(arguments):
    source, _ = source_and_rest(arguments)
    documents = all_documents(source)
    sources = [path.read_text() for path in sorted((source / "tests/install").glob("*/*.*"))]
    faults = [*order_of_documents(source), *jobs_of_ci(source)]
    for document in documents:
        name = document.path.relative_to(source)
        for fault in (*broken_links(document), *bad_blocks(document), *uncompiled(document, sources)):
            faults.append(f"{name}:{fault}")
    readme = documents[0]
    if len(readme.lines) > README_LINES:
        faults.append(f"README.md has {len(readme.lines)} lines, {README_LINES} at most")
    pictures = sum(line.startswith("![") for line in readme.lines)
    if pictures != README_PICTURES:
        faults.append(f"README.md has {pictures} pictures, not {README_PICTURES}")
    not_run = [f"{document.path.relative_to(source)}:{block.line}: {block.not_run}"
               for document in documents for block in document.blocks if block.not_run is not None]
    print("\n".join(["commands that no test runs:", *not_run]))
    if len(not_run) > NOT_RUN:
        faults.append(f"{len(not_run)} blocks of commands are not run, {NOT_RUN} at most")
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main(sys.argv[1:]))
