"""An SVG shown by a browser is the PNG, within the loose tolerance of picture tests, but for the levels that slanting
edges differ by: browsers smooth them over a wider square.

usage: vector_in_browser.py MOBBSCOPE BROWSER SCENES FOLDER      77: there is no browser
"""

import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from browser import Browser  # noqa: E402

program, browser, scenes = sys.argv[1:4]
folder = pathlib.Path(sys.argv[4]).absolute()
if not os.access(browser, os.X_OK):
    print("skipped: no Chromium; scripts/setup --ci installs it")
    sys.exit(77)
folder.mkdir(parents=True, exist_ok=True)
crossing = f"{scenes}/crossing.json"
pictures = {"boxes": ["render", crossing],
            "query": ["render", crossing, "--query", "0", "--step", "end"],
            "light": ["render", crossing, "--theme", "light", "--view", "top"],
            "map": ["map", crossing, "--over", "dx=-5:5,dy=-5:5", "--cells", "32x32", "--show", "clearance"]}
different = []
with Browser(browser, str(folder / "browser")) as opened:
    page = opened.page(1280, 720)
    for name, command in pictures.items():
        for ending in ("svg", "png"):
            subprocess.run([program, *command, "--size", "1280x720", "-o", f"{folder}/{name}.{ending}"], check=True,
                           stdout=subprocess.DEVNULL)
        page.open((folder / f"{name}.svg").as_uri())
        page.screenshot(f"{folder}/{name}.browser.png")
        status = subprocess.run([program, "diff", f"{folder}/{name}.browser.png", f"{folder}/{name}.png", "--threshold", "16",
                                 "--allowed", "0.5%", "--shift", "1", "-o", f"{folder}/{name}.heat.png"]).returncode
        if status != 0 or page.errors:
            different.append(name)
            print(f"{name}: {status}, {page.errors}")
sys.exit(1 if different else 0)
