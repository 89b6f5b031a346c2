"""Reads a report as a CI server or a browser does, fails for what is malformed, and prints what it says.

usage: parse_report.py junit|html FILE
"""

import base64
import html.parser
import struct
import sys
import xml.etree.ElementTree

VOID = {"meta", "img", "input", "rect"}


def junit(text):
    suite = xml.etree.ElementTree.fromstring(text).find("testsuite")
    counts = ", ".join(f"{key} {suite.get(key)}" for key in ("tests", "failures", "errors", "skipped"))
    print(f"suite {suite.get('name')}: {counts}")
    for case in suite.iter("testcase"):
        float(case.get("time"))
        assert "e" not in case.get("time")
        outcome = next((child for child in case if child.tag != "system-out"), None)
        if outcome is None:
            print(f"{case.get('name')}: passed")
        else:
            kind = f" ({outcome.get('type')})" if outcome.get("type") else ""
            print(f"{case.get('name')}: {outcome.tag}{kind}: {outcome.get('message')}")


class Page(html.parser.HTMLParser):
    """Tags in pairs, unique ids, links into the page, pictures inside it; sections and commands as text."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.unnamed = [], [], [], False
        self.sections, self.commands, self.title, self.text = [], [], "", ""

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag not in VOID:
            self.open.append(tag)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        if "href" in attributes:
            self.links.append(attributes["href"])
        assert not any(name.startswith("on") for name in attributes), attributes
        assert tag not in ("link", "iframe", "object", "form", "b"), tag
        kind = attributes.get("class")
        if tag == "section" or kind in ("passed", "skipped") and tag == "details":
            self.sections.append(["case" if tag == "section" else "folded", "", []])
            self.unnamed = True
        if tag in ("h2", "summary", "code", "title"):
            self.text = ""
        if tag == "figure":
            self.kind = kind
        if tag == "img":
            self.picture(attributes)
        elif "src" in attributes:
            raise AssertionError(f"{tag} loads {attributes['src']}")

    def picture(self, attributes):
        head, data = attributes["src"].split(",")
        assert head == "data:image/png;base64"
        data = base64.b64decode(data, validate=True)
        assert data[:8] == b"\x89PNG\r\n\x1a\n"
        width, height = struct.unpack(">II", data[16:24])
        assert (str(width), str(height)) == (attributes["width"], attributes["height"])
        assert attributes["alt"]
        self.sections[-1][2].append((self.kind + " " if self.kind else "") + f"{width}x{height}")

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
        self.open.pop()
        text = " ".join(self.text.split())
        if tag in ("h2", "summary") and self.unnamed:
            self.sections[-1][1], self.unnamed = text, False
        if tag == "code" and text:
            self.commands.append(text)
        if tag == "title":
            self.title = text

    def handle_data(self, data):
        self.text += data


def page(text):
    assert text.startswith("<!DOCTYPE html>")
    found = Page()
    found.feed(text)
    found.close()
    assert not found.open, found.open
    assert len(set(found.ids)) == len(found.ids), found.ids
    assert all(link[0] == "#" and link[1:] in found.ids for link in found.links), found.links
    print(f"title {found.title}")
    for kind, title, pictures in found.sections:
        print(f"{kind} {title}: {', '.join(pictures)}")
    for command in found.commands:
        print(f"command {command}")


sys.stdout.reconfigure(encoding="utf-8")
{"junit": junit, "html": page}[sys.argv[1]](open(sys.argv[2], encoding="utf-8").read())
