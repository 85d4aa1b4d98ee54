"""A browser without a window, driven by its debugging protocol over two pipes: no port, no driver."""

from __future__ import annotations

import base64
import json
import os
import re
import select
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

PROGRAM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
_SWITCHES = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-extensions",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
    "--hide-scrollbars",
    "--allow-file-access-from-files",
    "--remote-debugging-pipe",
)
_PATIENCE = 30.0


def printed(page: Path, folder: Path) -> Path:
    """Return a page as the browser prints it, in a folder."""
    assert PROGRAM
    target = folder / "printed.pdf"
    switches = ("--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer")
    profile = f"--user-data-dir={folder / 'profile'}"
    command = [PROGRAM, *switches, profile, f"--print-to-pdf={target}", page.as_uri()]
    subprocess.run(command, check=True, capture_output=True)
    return target


def pages_of(pdf: Path) -> int:
    """Return how many pages a file of the browser's has."""
    return len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes()))


class Page:
    """One page of a browser: what it logs, what it asks the network for, and what is evaluated in it."""

    def __init__(self, read: int, write: int) -> None:
        self._read, self._write = read, write
        self._count, self._rest = 0, b""
        self.messages: list[str] = []
        self.requests: list[str] = []
        target = self._call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self._call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    _session: str | None = None

    def call(self, method: str, **params: Any) -> Any:
        """Return what a method of the protocol answers, called on the page."""
        return self._call(method, **params)

    def _call(self, method: str, **params: Any) -> Any:
        self._count += 1
        number = self._count
        message: dict[str, Any] = {"id": number, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        return self._until(lambda found: found.get("id") == number)["result"]

    def _until(self, wanted: Any) -> Any:
        while True:
            found = self._next()
            self._keep(found)
            assert "error" not in found, found
            if wanted(found):
                return found

    def _next(self) -> Any:
        end = time.monotonic() + _PATIENCE
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._read], [], [], max(end - time.monotonic(), 0))
            assert ready, "the browser does not answer"
            more = os.read(self._read, 1 << 20)
            assert more, "the browser has ended"
            self._rest += more
        line, _, self._rest = self._rest.partition(b"\0")
        return json.loads(line)

    def _keep(self, found: Any) -> None:
        match found.get("method"):
            case "Runtime.consoleAPICalled" | "Runtime.exceptionThrown" | "Log.entryAdded":
                self.messages.append(json.dumps(found["params"]))
            case "Network.requestWillBeSent":
                self.requests.append(found["params"]["request"]["url"])

    def go(self, url: str) -> None:
        """Open an address, and wait until all of it shows: before that the mouse does nothing."""
        self.messages.clear()
        self.requests.clear()
        self.call("Page.navigate", url=url)
        self._until(lambda found: found.get("method") == "Page.loadEventFired")
        self.frame()

    def value(self, script: str) -> Any:
        """Return the value of an expression in the page, of a promise what it becomes."""
        found = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def frame(self) -> None:
        """Wait until what was done shows."""
        self.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")

    def key(self, key: str, **more: Any) -> None:
        """Press a key and let go of it."""
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, **more)
        self.frame()

    def mouse(self, kind: str, x: float, y: float) -> None:
        """Move the mouse, or press and release its left button."""
        held = 0 if kind == "mouseReleased" else 1
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=held, clickCount=1)

    def sized(self, width: int, height: int, scale: float = 1.0, *, touch: bool = False) -> None:
        """Give the page a size in its own pixels, each so many of the screen's."""
        size = {"width": width, "height": height, "deviceScaleFactor": scale, "mobile": touch}
        self.call("Emulation.setDeviceMetricsOverride", **size)

    def prefer(self, **features: str) -> None:
        """Set what a reader prefers, such as color_scheme="dark"."""
        named = [{"name": f"prefers-{name.replace('_', '-')}", "value": features[name]} for name in features]
        self.call("Emulation.setEmulatedMedia", features=named)

    def shot(self) -> bytes:
        """Return what shows, as PNG."""
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])


@contextmanager
def browser(folder: Path) -> Iterator[Page]:
    """Give a page of a new browser, which keeps what it keeps in a folder, and end it."""
    assert PROGRAM
    (their_read, write), (read, their_write) = os.pipe(), os.pipe()
    command = f'exec "$0" "$@" 3<&{their_read} 4>&{their_write}'
    words = ["bash", "-c", command, PROGRAM, *_SWITCHES, f"--user-data-dir={folder}", "about:blank"]
    with subprocess.Popen(
        words,
        pass_fds=(their_read, their_write),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={name: value for name, value in os.environ.items() if name != "DISPLAY"},
    ) as process:
        os.close(their_read)
        os.close(their_write)
        try:
            yield Page(read, write)
        finally:
            process.terminate()
            process.wait(_PATIENCE)
            os.close(read)
            os.close(write)
