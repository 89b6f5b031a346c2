"""The page of picture tests in a real browser, worked by keys, mouse and finger.

usage: report_in_browser.py PROGRAM BROWSER FOLDER      77: there is no browser, or nothing to draw with
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from browser import Browser  # noqa: E402

SCENE = {"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [0.6, 0.1, 0.4], [1.2, 0, 0.4], [1.8, -0.1, 0.4]]}},
         "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [1, -1]}],
         "fit": {"leaf": 2}}
HOSTILE = "evil</script><img src=x onerror=document.title='owned'>"


class Folder:
    """Cases of small scenes, the program run on them, and the page that it writes."""

    def __init__(self, name):
        self.path = WORK / name
        self.cases = self.path / "my cases"
        shutil.rmtree(self.path, ignore_errors=True)
        self.cases.mkdir(parents=True)
        self.scene("still", SCENE)

    def scene(self, name, scene):
        (self.cases / f"{name}.json").write_text(json.dumps(scene))

    def case(self, name, **case):
        file = self.cases / f"{name}.case.json"
        file.parent.mkdir(exist_ok=True, parents=True)
        case = {"mobbscope_case": 1, "scene": str(self.cases / "still.json"), "size": "320x180"} | case
        case = {key: value for key, value in case.items() if value is not None}
        file.write_text(json.dumps(case))

    def move(self, name):
        """What is drawn of this scene is another now."""
        self.scene(name, SCENE | {"agents": [SCENE["agents"][0], SCENE["agents"][1] | {"translate": [1.3, -1]}]})

    def test(self, *options):
        return self.run(f"mobbscope test 'my cases' {' '.join(options)}")

    def run(self, command):
        """As a person types it; 3 skips all."""
        done = subprocess.run(["sh", "-c", command], cwd=self.path, capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"})
        if done.returncode == 3:
            print(f"skipped: {done.stderr}")
            sys.exit(77)
        if done.returncode not in (0, 1):
            raise RuntimeError(f"{command}: {done.stderr}")
        return done

    @property
    def page(self):
        return (self.path / "report.html").as_uri()


def moved_cases(folder, names, **case):
    folder.scene("moved", SCENE)
    for name in names:
        folder.case(name, scene=str(folder.cases / "moved.json"), **case)


def all_outcomes():
    """Two of each kind that is shown whole, one that cannot be read, one that waits, three that pass."""
    folder = Folder("all outcomes")
    # Wider than a phone.
    moved_cases(folder, ["alpha/one", "beta two"], size="640x360")
    for name in ("fine", "also fine", "alpha/fine"):
        folder.case(name)
    folder.test("--update all")
    folder.move("moved")
    folder.case("new")
    folder.case(HOSTILE, scene=f"none {HOSTILE.replace('/', ' ')}.json")
    folder.case("later", skip="waits for <rain>")
    folder.test("--html report.html")
    return folder


# The names of the cases that are shown, in their order.
SHOWN = "all('.case').filter(section => section.checkVisibility()).map(section => section.dataset.name)"
LISTED = "all('nav li').filter(row => row.checkVisibility()).map(row => row.dataset.name)"
CHIPS = "Object.fromEntries(chips.map(chip => [chip.dataset.chip, Number(one('.count', chip).textContent)]))"
COMMAND = "one('.decision code').textContent"
OUTCOMES = {"failed": 1, "different": 2, "missing": 1, "skipped": 1, "passed": 3}
ALL = [HOSTILE, "alpha/one", "beta two", "new"]

# Each text that is seen, with its size and its contrast to what is behind it.
TEXTS = """(() => {
    const channels = color => color.match(/[\\d.]+/g).map(Number);
    const light = color => channels(color).slice(0, 3).map(value => value / 255)
        .map(value => value <= .04045 ? value / 12.92 : ((value + .055) / 1.055) ** 2.4)
        .reduce((sum, value, i) => sum + value * [.2126, .7152, .0722][i], 0);
    const behind = element => {
        for (let at = element; at; at = at.parentElement) {
            const color = getComputedStyle(at).backgroundColor;
            if ((channels(color)[3] ?? 1) === 1) return color;
        }
        return 'rgb(255, 255, 255)';
    };
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    while (walker.nextNode()) {
        const element = walker.currentNode.parentElement;
        if (!walker.currentNode.data.trim() || !element.checkVisibility()) continue;
        const style = getComputedStyle(element);
        const [a, b] = [light(style.color), light(behind(element))].sort((x, y) => y - x);
        found.push({text: walker.currentNode.data.trim().slice(0, 40), size: parseFloat(style.fontSize),
                    contrast: (a + .05) / (b + .05)});
    }
    return found;
})()"""


# What reaches beyond a phone, but for what is scrolled or enlarged by itself.
TOO_WIDE = """all('body *')
    .filter(element => element.checkVisibility() && !element.parentElement.closest('.chips, code, .paper, dialog'))
    .filter(element => element.getBoundingClientRect().right > 390.5)
    .map(element => element.outerHTML.slice(0, 60))"""


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = all_outcomes()
        cls.browser = Browser(BROWSER, str(WORK / "browser"))

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, width=1280, height=900, phone=False, fragment="", **media):
        page = self.browser.page(width, height, phone)
        page.media(**media)
        page.open(self.folder.page + fragment)
        self.addCleanup(page.call, "Page.close")
        self.addCleanup(lambda: self.assertEqual(page.errors, []))
        return page

    def go_to(self, page, name):
        page.click(f"nav a[href='#case{ALL.index(name)}']")
        page.wait(f"document.activeElement.dataset.name === {json.dumps(name)}")

    def test_asks_for_nothing_and_complains_of_nothing(self):
        page = self.open()
        for key in "jj1234szzzaA/":
            page.press(key)
        page.press("Escape")
        page.press("?", shift=True)
        page.wait("keys.open")
        page.press("Escape")
        page.wait("!keys.open")
        page.click("main > details.passed summary")
        page.click(".thumbnail")
        asked = [address for address in page.requests if not address.startswith("data:")]
        self.assertEqual(asked, [self.folder.page])

    def test_names_and_messages_are_text(self):
        page = self.open()
        self.assertEqual(page.evaluate("all('img').filter(img => !img.src.startsWith('data:image/png')).length"), 0)
        self.assertEqual(page.evaluate("document.title"), "4 of 8 picture tests did not pass - my cases")
        self.assertIn(HOSTILE, page.evaluate("one('#case0 h2').textContent"))
        self.assertIn("onerror", page.evaluate("one('#case0 .message').textContent"))
        self.assertEqual(page.evaluate("all('.skipped dd').map(dd => dd.textContent)"), ["waits for <rain>"])

    def test_causes_stand_before_what_follows_from_them(self):
        page = self.open()
        lines = page.evaluate("all('#case1 div.words li').map(line => line.textContent)")
        self.assertIn(" moved by (", lines[0])
        self.assertEqual([line for line in lines if line.startswith(("disks of ", "boxes of "))], [], lines)

    def test_a_text_filters_cases_list_and_counts(self):
        page = self.open()
        self.assertEqual(page.evaluate(SHOWN), ALL)
        self.assertEqual(page.evaluate(CHIPS), OUTCOMES)
        page.press("/")
        page.write("ALPHA")
        self.assertEqual(page.evaluate(SHOWN), ["alpha/one"])
        self.assertEqual(page.evaluate(LISTED), ["alpha/one"])
        self.assertEqual(page.evaluate(CHIPS), dict.fromkeys(OUTCOMES, 0) | {"different": 1, "passed": 1})
        self.assertEqual(page.evaluate("one('.shown').textContent"), "2 of 8 shown")
        self.assertEqual(page.evaluate("one('.passed .count').textContent"), "1 of 3")
        # Each word, of the name or of a message.
        page.write(" moved")
        self.assertEqual(page.evaluate(SHOWN), ["alpha/one"])
        page.write(" nowhere")
        self.assertEqual(page.evaluate(SHOWN), [])
        self.assertTrue(page.evaluate("one('.nothing').checkVisibility()"))
        page.press("Escape")
        self.assertEqual(page.evaluate(SHOWN), ALL)
        self.assertFalse(page.evaluate("one('.nothing').checkVisibility()"))
        page.press("/")
        page.write("rain")
        self.assertTrue(page.evaluate("one('.skipped dd').checkVisibility()"), "what alone is found is unfolded")

    def test_chips_hide_outcomes(self):
        page = self.open()
        page.click("[data-chip=different]")
        self.assertEqual(page.evaluate(SHOWN), [HOSTILE, "new"])
        self.assertEqual(page.evaluate(LISTED), [HOSTILE, "new"])
        self.assertEqual(page.evaluate("one('.shown').textContent"), "6 of 8 shown")
        page.click("[data-chip=passed]")
        self.assertFalse(page.evaluate("one('main > .passed').checkVisibility()"))
        page.press("/")
        page.write("new")
        page.press("Escape")
        page.press("Escape")
        self.assertEqual(page.evaluate(SHOWN), [HOSTILE, "new"], "Escape clears the text alone")
        page.press("/")
        page.write("nowhere")
        page.click(".showall")
        self.assertEqual(page.evaluate(SHOWN), ALL)

    def test_the_first_step_goes_to_the_first_case(self):
        # Its bottom is above the upper third of a high window.
        for height in (900, 1500):
            page = self.open(1280, height)
            current = "all('nav [aria-current]').map(link => [link.hash, link.getAttribute('aria-current')])"
            self.assertEqual(page.evaluate(current), [["#case0", "location"]])
            page.press("j")
            page.wait("document.activeElement.id === 'case0'")
            self.assertEqual(page.evaluate(current), [["#case0", "true"]])

    def test_a_key_that_is_held_marks_once(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        for repeat in (False, True, True, True):
            page.call("Input.dispatchKeyEvent", type="keyDown", text="a", key="a", windowsVirtualKeyCode=65,
                      autoRepeat=repeat)
        self.assertEqual(page.evaluate("marked().length"), 1)

    def test_order_is_that_of_cases_list_and_keys(self):
        page = self.open()
        page.click("[data-by=name]")
        names = sorted(ALL)
        self.assertEqual(page.evaluate(SHOWN), names)
        self.assertEqual(page.evaluate(LISTED), names)
        for name in names:
            page.press("j")
            page.wait(f"document.activeElement.dataset.name === {json.dumps(name)}")
        page.press("k")
        page.wait(f"document.activeElement.dataset.name === {json.dumps(names[-2])}")

    def test_the_address_shows_the_same_again(self):
        page = self.open()
        page.press("/")
        page.write("a")
        page.press("Enter")
        page.click("[data-chip=failed]")
        page.click("[data-by=name]")
        self.go_to(page, "beta two")
        page.press("a")
        fragment = page.evaluate("location.hash")
        again = self.open(fragment=fragment)
        for what in (SHOWN, LISTED, CHIPS, COMMAND, "filter.value", "location.hash", "orders.find(pressed).dataset.by",
                     "document.activeElement.dataset.name"):
            self.assertEqual(again.evaluate(what), page.evaluate(what), what)
        self.assertEqual(again.evaluate("document.activeElement.dataset.name"), "beta two")
        again.wait("one('#case2').getBoundingClientRect().top >= one('header').getBoundingClientRect().bottom")
        again.evaluate("location.hash = '#case3'")
        again.wait("document.activeElement.id === 'case3'")
        self.assertEqual(again.evaluate("filter.value"), "", "a plain link shows all")

    def test_keys_choose_how_to_compare(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        seen = """['golden', 'actual', 'difference'].filter(kind =>
            one(`#case1 .${kind} .paper`).checkVisibility({visibilityProperty: true}))"""
        self.assertEqual(page.evaluate(seen), ["golden", "actual", "difference"])
        page.press("4")
        self.assertEqual(page.evaluate(seen), ["difference"])
        page.press("3")
        self.assertEqual(page.evaluate(seen), ["golden", "actual"])
        self.assertEqual(page.evaluate("one('#case1 [data-mode=slide][aria-pressed]').ariaPressed"), "true")
        # The next case is shown the same way.
        page.press("j")
        page.wait("one('#case2 .pictures').dataset.mode === 'slide'")
        page.press("k")
        page.press("1")
        self.assertEqual(page.evaluate(seen), ["golden", "actual", "difference"])

    def test_blinking_swaps_by_itself_and_by_hand(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        page.press("2")
        sees = "one('#case1 .{} img').checkVisibility({{visibilityProperty: true}})"
        for kind in ("actual", "golden", "actual"):
            page.wait(sees.format(kind))
        page.press("s")
        swaps = """new Promise(resolve => {
            let count = 0;
            new MutationObserver(() => ++count).observe(one('#case1 .pictures'), {attributes: true});
            setTimeout(() => resolve(count), 3 * kBlinkMs);
        })"""
        self.assertEqual(page.evaluate(swaps), 0, "by hand alone, once it was by hand")
        calm = self.open(prefers_reduced_motion="reduce")
        self.go_to(calm, "alpha/one")
        calm.press("2")
        for kind, other in (("actual", "golden"), ("golden", "actual")):
            calm.press("s")
            self.assertTrue(calm.evaluate(sees.format(kind)))
            self.assertFalse(calm.evaluate(sees.format(other)))

    def slide_of(self, page):
        """Where the actual picture begins, in percent, as it is drawn and as the slider says: the golden is left of it."""
        clip = page.evaluate("getComputedStyle(one('#case1 .actual .paper')).clipPath")
        self.assertRegex(clip, r"^inset\(0px 0px 0px [\d.]+%\)$")
        return float(clip.split()[-1].rstrip("%)")), page.evaluate("one('#case1 .slider input').valueAsNumber")

    def test_the_slider_follows_mouse_and_finger(self):
        for phone in (False, True):
            page = self.open(*((390, 844) if phone else (1280, 900)), phone)
            page.evaluate("chooseMode(one('#case1'), 'slide')")
            x, y, width, _ = page.middle("#case1 .actual .paper")
            left = x - width / 2
            (page.swipe if phone else page.drag)((left + width * 0.5, y), (left + width * 0.25, y + 3))
            begins, at = self.slide_of(page)
            self.assertAlmostEqual(at, 25, delta=1)
            self.assertAlmostEqual(begins, at, delta=0.1)
            self.assertLess(*[page.evaluate(f"one('#case1 .{kind} figcaption small').getBoundingClientRect().right")
                              for kind in ("golden", "actual")])
            page.evaluate("one('#case1 .slider input').value = 80")
            page.evaluate("one('#case1 .slider input').dispatchEvent(new Event('input'))")
            self.assertEqual(self.slide_of(page)[0], 80)

    def test_pictures_are_enlarged_and_moved_together(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        transforms = "all('#case1 .sheet').map(sheet => sheet.style.transform)"
        self.assertEqual(page.evaluate(transforms), ["", "", ""])
        while "800" not in page.evaluate("one('#case1 .enlarge').textContent"):
            before = page.evaluate(transforms)
            page.press("z")
            self.assertNotEqual(page.evaluate(transforms), before)
        first = page.evaluate(transforms)
        self.assertEqual(len(set(first)), 1)
        self.assertEqual(page.evaluate("getComputedStyle(one('#case1 .golden img')).imageRendering"), "pixelated")
        # What is in the middle differs: within what differs, at least.
        inside = page.evaluate("""(() => {
            const {x, y} = views.get(one('#case1'));
            const rect = one('#case1 .sheet rect').getBBox();
            return x >= rect.x && x <= rect.x + rect.width && y >= rect.y && y <= rect.y + rect.height;
        })()""")
        self.assertTrue(inside)
        x, y, *_ = page.middle("#case1 .golden .paper")
        page.drag((x, y), (x + 40, y + 20))
        moved = page.evaluate(transforms)
        self.assertEqual(len(set(moved)), 1)
        place = "(({x, y}) => [x, y])(views.get(one('#case1')))"
        there = page.evaluate(place)
        page.drag((x, y), (x - 16, y - 24))
        self.assertEqual(page.evaluate(place), [there[0] + 2, there[1] + 3], "8 pixels for one")
        self.assertNotEqual(moved, first)
        page.press("z", shift=True)
        self.assertIn("400", page.evaluate("one('#case1 .enlarge').textContent"))
        while "fit" not in page.evaluate("one('#case1 .enlarge').textContent"):
            page.press("z", shift=True)
        self.assertEqual(page.evaluate(transforms), ["", "", ""])
        page.click("#case1 .actual .paper")
        page.wait("one('#case1 .pictures').classList.contains('enlarged')")

    def test_a_phone_shows_all_without_scrolling_aside(self):
        for media in ({"prefers_color_scheme": "light"}, {"prefers_color_scheme": "dark"}):
            page = self.open(390, 844, phone=True, **media)
            page.press("j")
            page.press("a")
            for fold in (False, True):
                if fold:
                    page.evaluate("all('details').forEach(details => details.open = true)")
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)
                self.assertEqual(page.evaluate(TOO_WIDE), [])
                self.assertGreaterEqual(min(page.evaluate(TEXTS), key=lambda text: text["size"])["size"], 12)
            # What stays at top and bottom leaves room.
            bars = page.evaluate("['--head', '--foot'].map(name => parseFloat(document.documentElement.style."
                                 "getPropertyValue(name))).reduce((sum, height) => sum + height)")
            self.assertLess(bars, 844 / 6)
        page = self.open(390, 844, phone=True)
        self.assertFalse(page.evaluate("one('nav').checkVisibility()"), "it is folded")
        self.assertEqual(page.evaluate("all('kbd').filter(key => key.checkVisibility()).length"), 0)
        first, last = (page.evaluate(f"one('{what}').getBoundingClientRect().top") for what in ("#case0", ".side"))
        self.assertLess(first, last, "the cases come first")
        self.assertEqual(page.evaluate("all('.chip').filter(chip => chip.getBoundingClientRect().right > 390).length"), 0)
        # The button stands beside the title.
        narrow = self.open(390, 844)
        right = narrow.evaluate("""(() => {
            const title = document.createRange();
            title.selectNodeContents(one('h1'));
            return title.getBoundingClientRect().right;
        })()""")
        self.assertLessEqual(right, narrow.evaluate("one('.helps').getBoundingClientRect().left"))

    def test_pictures_use_the_width(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        card = page.evaluate("one('#case1').clientWidth")
        widths = "['golden', 'actual', 'difference'].map(kind => one(`#case1 .${kind} img`).clientWidth)"
        for width in page.evaluate(widths):
            self.assertGreater(width, 0.45 * card)
        page.press("2")
        for width in page.evaluate(widths)[:2]:
            self.assertGreater(width, 0.95 * card)

    def test_print_has_what_was_found_and_nothing_to_press(self):
        page = self.open()
        self.go_to(page, "alpha/one")
        page.press("a")
        page.call("Emulation.setEmulatedMedia", media="print")
        self.assertEqual(page.evaluate("all('button, .take, .command, .decision, #filter')"
                                       ".filter(it => it.checkVisibility() && !it.matches('.thumbnail')).length"), 0)
        self.assertEqual(page.evaluate(SHOWN), ALL)
        self.assertEqual(page.evaluate("getComputedStyle(one('header')).position"), "static")

    def test_text_is_legible_in_both_themes(self):
        grounds = set()
        for scheme in ("light", "dark"):
            page = self.open(prefers_color_scheme=scheme)
            page.press("j")
            page.press("j")
            page.press("a")
            page.click("[data-chip=skipped]")
            page.evaluate("all('details').forEach(details => details.open = true)")
            texts = page.evaluate(TEXTS)
            self.assertGreater(len(texts), 50)
            faint = [text for text in texts if text["contrast"] < 4.5]
            self.assertEqual(faint, [])
            grounds.add(page.evaluate("getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(grounds), 2)

    def test_without_scripts_all_can_be_read(self):
        page = self.browser.page(1280, 900)
        self.addCleanup(page.call, "Page.close")
        page.open(self.folder.page, scripts=False)
        self.assertEqual(page.evaluate("document.querySelectorAll('.scripted, .tools:not([hidden])').length"), 0)
        self.assertEqual(page.evaluate("[...document.querySelectorAll('.case')].every(it => it.checkVisibility())"), True)
        # Not innerText, which lacks what is far below the window.
        text = page.evaluate("[...document.querySelectorAll('.case')].map(it => it.textContent).join(' ')")
        for result in json.loads(self.folder.test("--json", "--output out").stdout)["cases"]:
            if result["outcome"] in ("passed", "skipped"):
                continue
            self.assertIn(result["name"], text)
            # The page has parts of it under headings of their own.
            self.assertIn(result["message"].split("; ")[0].split(" of ")[0], text)
        self.assertIn("mobbscope test 'my cases' new --accept report.html",
                      page.evaluate("document.querySelector('#case3').textContent"))

    def test_marked_cases_have_one_command(self):
        page = self.open()
        self.assertFalse(page.evaluate("one('.decision code').checkVisibility()"))
        self.go_to(page, "beta two")
        page.press("a")
        self.assertEqual(page.evaluate(COMMAND), "mobbscope test 'my cases' 'beta two' --accept report.html")
        self.assertTrue(page.evaluate("one('.decision code').checkVisibility()"))
        page.press("/")
        page.write("new")
        page.click(".markall")
        self.assertEqual(page.evaluate(COMMAND), "mobbscope test 'my cases' 'beta two' new --accept report.html")
        self.assertEqual(page.evaluate("one('.marked').textContent"), "2 of 3 marked, 1 of them not shown")
        page.click("#case3 .take")
        self.assertEqual(page.evaluate(COMMAND), "mobbscope test 'my cases' 'beta two' --accept report.html")
        page.click(".decision .copy")
        page.wait("one('.decision .copy').textContent !== 'Copy'")
        page.click(".unmark")
        self.assertEqual(page.evaluate("marked().length"), 0)
        self.assertFalse(page.evaluate("one('.decision code').checkVisibility()"))
        page.press("Escape")
        self.go_to(page, HOSTILE)
        page.press("a")
        self.assertEqual(page.evaluate("marked().length"), 0, "what failed cannot be accepted")

    def test_one_of_three_is_accepted_from_the_page_alone(self):
        folder = Folder("three")
        names = ["it's $HOME", "left", "right"]
        moved_cases(folder, names)
        folder.case("fine")
        folder.test("--update all")
        folder.move("moved")
        self.assertEqual(folder.test("--html report.html").returncode, 1)
        before = {file: file.read_bytes() for file in folder.cases.glob("*.png")}
        page = self.browser.page(1280, 900)
        self.addCleanup(page.call, "Page.close")
        page.open(folder.page)
        self.assertEqual(page.evaluate("cases.length"), 3)
        page.press("j")
        page.press("2")
        page.press("a")
        accepted = folder.run(page.evaluate(COMMAND))
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        changed = [file.name for file, data in before.items() if file.read_bytes() != data]
        self.assertEqual(changed, ["it's $HOME.png"])
        again = json.loads(folder.test("--json").stdout)
        failing = [result["name"] for result in again["cases"] if result["outcome"] != "passed"]
        self.assertEqual(failing, ["left", "right"])
        self.assertEqual(urllib.parse.unquote_plus(page.evaluate("location.hash")),
                         "#accept=it's $HOME&case=it's $HOME")

    def test_a_name_with_a_dash_is_no_option(self):
        folder = Folder("dashes")
        for name in ("--strict", "-o", "plain"):
            folder.case(name)
        self.assertEqual(folder.test("--html report.html").returncode, 1)
        page = self.browser.page(1280, 900)
        self.addCleanup(page.call, "Page.close")
        page.open(folder.page)
        page.press("A", shift=True)
        page.click("#case1 .take")
        self.assertEqual(page.evaluate(COMMAND), "mobbscope test 'my cases' --accept report.html -- --strict plain")
        self.assertEqual(folder.run(page.evaluate(COMMAND)).returncode, 0)
        commands = page.evaluate("all('#case1 code').map(code => code.textContent)")
        self.assertEqual(commands, ["mobbscope test 'my cases' --accept report.html -- -o",
                                    "mobbscope test 'my cases' --update --update=-o"])
        for command in commands:
            golden = folder.cases / "-o.png"
            golden.unlink(missing_ok=True)
            self.assertEqual(folder.run(command).returncode, 0, command)
            self.assertTrue(golden.is_file(), command)

    def test_answers_without_a_picture_and_what_the_scene_expects(self):
        folder = Folder("answers")
        folder.scene("expects", SCENE | {"queries": [{"a": "A", "b": "B", "expect": {"collides": True}}]})
        folder.case("answers", scene=str(folder.cases / "expects.json"), size=None, hold=["answers"])
        folder.move("moved")
        folder.case("picture", scene=str(folder.cases / "moved.json"))
        self.assertEqual(folder.test("--html report.html").returncode, 1)
        page = self.browser.page(1280, 900)
        self.addCleanup(page.call, "Page.close")
        page.open(folder.page)
        section = "cases.find(section => section.dataset.name === 'answers')"
        self.assertEqual(page.evaluate(f"all('img, .modes, .pictures', {section}).length"), 0)
        headings = page.evaluate(f"all('h3', {section}).map(heading => heading.textContent.trim())")
        self.assertIn("What the scene expects", headings)
        self.assertIn("Accepting writes the goldens. The case passes once the scene expects this answer, too.",
                      page.evaluate(f"{section}.textContent"))
        # All keys work there too.
        page.evaluate(f"goTo({section})")
        for key in "1234szZ":
            page.press(key)
        page.press("a")
        self.assertEqual(page.errors, [])
        folder.run(page.evaluate(COMMAND))
        self.assertTrue((folder.cases / "answers.answers.json").is_file())
        # What is left is the scene's: nothing can be accepted.
        self.assertEqual(json.loads(folder.test("--json", "--html report.html").stdout)["cases"][0]["outcome"],
                         "different")
        page.open(folder.page)
        self.assertEqual(page.evaluate(f"all('h3', {section}).map(heading => heading.textContent.trim())"),
                         ["What the scene expects"])
        self.assertEqual(page.evaluate(f"box({section})"), None)
        self.assertNotIn("Accepting writes", page.evaluate(f"{section}.textContent"))


if __name__ == "__main__":
    PROGRAM, BROWSER, WORK = pathlib.Path(sys.argv[1]).absolute(), sys.argv[2], pathlib.Path(sys.argv[3]).absolute()
    if not os.access(BROWSER, os.X_OK):
        print("skipped: no Chromium; scripts/setup --ci installs it")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
