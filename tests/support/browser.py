"""Chromium without a display, worked as a person works it: by the DevTools protocol over a pipe.

    with Browser("/usr/bin/chromium", "profile folder") as browser:
        page = browser.page(1280, 900)
        page.open("file:///report.html")
        page.press("j")
        page.wait("document.activeElement.id === 'case0'")

Whoever waits fails after `Browser.PATIENCE` seconds, never sooner: machines may be slow.
"""

import base64
import fcntl
import json
import os
import select
import signal
import subprocess
import time


class Browser:
    PATIENCE = 120

    def __init__(self, program, folder):
        os.makedirs(folder, exist_ok=True)
        self.log = open(os.path.join(folder, "browser.log"), "wb")
        self.buffer, self.last, self.pages = b"", 0, {}
        # The browser reads from 3 and writes to 4; ends with those numbers here must not be in the way.
        its_input, self.output = os.pipe()
        self.input, its_output = os.pipe()
        high = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (its_input, its_output)]

        def connect():
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
             "--disable-dev-shm-usage", "--disable-background-networking", "--force-device-scale-factor=1",
             "--remote-debugging-pipe", f"--user-data-dir={folder}/profile"],
            stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log, pass_fds=(3, 4), preexec_fn=connect,
            start_new_session=True, env={**os.environ, "HOME": folder})
        for end in (its_input, its_output, *high):
            os.close(end)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        try:
            self.call("Browser.close")
            self.process.wait(self.PATIENCE)
        except (RuntimeError, subprocess.TimeoutExpired, OSError):
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        os.close(self.input)
        os.close(self.output)
        self.log.close()

    def call(self, method, session=None, **parameters):
        """Its result; throws RuntimeError for what the browser refuses."""
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.output, data):]
        deadline = time.monotonic() + self.PATIENCE
        while True:
            answer = self.message(deadline, method)
            if answer.get("id") == self.last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def message(self, deadline, what):
        """The next message; those that are events also go to their page."""
        while b"\0" not in self.buffer:
            if not select.select([self.input], [], [], max(deadline - time.monotonic(), 0))[0]:
                raise RuntimeError(f"{what}: no answer within {self.PATIENCE} s")
            data = os.read(self.input, 1 << 20)
            if not data:
                raise RuntimeError(f"{what}: the browser has ended; see {self.log.name}")
            self.buffer += data
        text, self.buffer = self.buffer.split(b"\0", 1)
        message = json.loads(text)
        if message.get("sessionId") in self.pages and "method" in message:
            self.pages[message["sessionId"]].take(message["method"], message["params"])
        return message

    def page(self, width, height, phone=False):
        return Page(self, width, height, phone)


class Page:
    """One tab. `errors`: what its console and its scripts complain of; `requests`: the addresses that it asked for."""

    def __init__(self, browser, width, height, phone):
        self.browser, self.errors, self.requests, self.loaded = browser, [], [], False
        self.target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.call("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        browser.pages[self.session] = self
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.resize(width, height, phone)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def take(self, method, parameters):
        if method == "Page.loadEventFired":
            self.loaded = True
        elif method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "assert"):
            self.errors.append(str(parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])

    def resize(self, width, height, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=phone)

    def media(self, **features):
        """Such as prefers_color_scheme="dark"."""
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def open(self, address, scripts=True):
        self.call("Emulation.setScriptExecutionDisabled", value=not scripts)
        # An address that differs in its fragment alone would not load anything.
        self.call("Page.navigate", url="about:blank")
        self.loaded = False
        failure = self.call("Page.navigate", url=address).get("errorText")
        if failure:
            raise RuntimeError(f"{address}: {failure}")
        deadline = time.monotonic() + self.browser.PATIENCE
        while not self.loaded or self.evaluate("document.readyState") != "complete":
            if not self.loaded:
                self.browser.message(deadline, address)

    def evaluate(self, expression):
        """The value of JavaScript, as JSON has it; throws RuntimeError for an error in it."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']['exception']['description']}")
        return answer["result"].get("value")

    def wait(self, expression):
        """Until it is true."""
        deadline = time.monotonic() + self.browser.PATIENCE
        while not self.evaluate(expression):
            if time.monotonic() > deadline:
                raise RuntimeError(f"never became true: {expression}")
            time.sleep(0.02)

    def press(self, key, shift=False):
        """A key as it stands on it: "j", "/", "Escape", "Enter"."""
        named = {"Enter": ("\r", 13), "Escape": ("", 27), "Tab": ("", 9)}
        text, code = named[key] if key in named else (key, ord(key.upper()))
        about = {"key": key, "windowsVirtualKeyCode": code, "modifiers": 8 if shift else 0}
        self.call("Input.dispatchKeyEvent", type="keyDown", text=text, **about)
        self.call("Input.dispatchKeyEvent", type="keyUp", **about)

    def write(self, text):
        self.call("Input.insertText", text=text)

    def middle(self, selector):
        """Where an element is in the window, which is scrolled to it if need be."""
        place = self.evaluate(f"""(() => {{
            const element = document.querySelector({json.dumps(selector)});
            if (!element) return null;
            element.scrollIntoView({{block: 'center', inline: 'center', behavior: 'instant'}});
            const {{x, y, width, height}} = element.getBoundingClientRect();
            return [x + width / 2, y + height / 2, width, height];
        }})()""")
        if not place:
            raise RuntimeError(f"there is no {selector}")
        return place

    def mouse(self, kind, x, y, pressed=True):
        self.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, button="left", clickCount=1,
                  buttons=int(pressed))

    def click(self, selector):
        x, y, *_ = self.middle(selector)
        self.mouse("Pressed", x, y)
        self.mouse("Released", x, y, False)

    def drag(self, begin, end):
        """From one place in the window to another, by the mouse."""
        self.mouse("Pressed", *begin)
        self.mouse("Moved", (begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2)
        self.mouse("Moved", *end)
        self.mouse("Released", *end, False)

    def swipe(self, begin, end):
        """The same by a finger."""
        steps = [("touchStart", begin), *(
            ("touchMove", [begin[axis] + (end[axis] - begin[axis]) * part / 4 for axis in (0, 1)])
            for part in range(1, 5))]
        for kind, (x, y) in steps:
            self.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y}])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def screenshot(self, file):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(file, "wb") as out:
            out.write(base64.b64decode(data))
