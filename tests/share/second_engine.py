"""A second browser without a window, of another make: Firefox, driven by its Marionette protocol."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
_PATIENCE = 60.0
_KEYS = {"ArrowLeft": "\ue012", "ArrowRight": "\ue014", "Shift": "\ue008"}
_LOGGED = """
return Services.console.getMessageArray()
    .filter(one => one instanceof Ci.nsIScriptError && one.sourceName.startsWith("file:"))
    .map(one => one.errorMessage);
"""


class SecondPage:
    """One page of Firefox: what is evaluated in it, what it logs, and what it loads."""

    def __init__(self, link: socket.socket) -> None:
        self._link, self._rest, self._count = link, b"", 0
        self._next()
        self._call("WebDriver:NewSession", {})

    def _call(self, name: str, values: dict[str, Any]) -> Any:
        self._count += 1
        message = json.dumps([0, self._count, name, values])
        self._link.sendall(f"{len(message)}:{message}".encode())
        _, _, error, result = self._next()
        assert error is None, error
        return result

    def _next(self) -> Any:
        while b":" not in self._rest or len(self._rest) < self._end():
            more = self._link.recv(1 << 20)
            assert more, "the browser has ended"
            self._rest += more
        end = self._end()
        found, self._rest = self._rest[:end].partition(b":")[2], self._rest[end:]
        return json.loads(found)

    def _end(self) -> int:
        """Return where the next message ends, by the length that stands before it."""
        length, colon, _ = self._rest.partition(b":")
        return int(length) + len(length) + len(colon)

    def go(self, url: str) -> None:
        """Open an address, and wait until it is loaded."""
        self._in("chrome", "Services.console.reset();")
        self._call("WebDriver:Navigate", {"url": url})

    def _in(self, context: str, script: str) -> Any:
        self._call("Marionette:SetContext", {"value": context})
        try:
            return self._call("WebDriver:ExecuteScript", {"script": script, "args": []})["value"]
        finally:
            self._call("Marionette:SetContext", {"value": "content"})

    def value(self, script: str) -> Any:
        """Return the value of an expression in the page."""
        return self._call("WebDriver:ExecuteScript", {"script": f"return {script};", "args": []})["value"]

    def frame(self) -> None:
        """Wait until what was done shows."""
        wait = (
            "const done = arguments[arguments.length - 1];"
            "requestAnimationFrame(() => requestAnimationFrame(() => done(0)));"
        )
        self._call("WebDriver:ExecuteAsyncScript", {"script": wait, "args": []})

    def key(self, *keys: str) -> None:
        """Press keys one upon the other and let go of them."""
        codes = [_KEYS.get(key, key) for key in keys]
        presses = [{"type": "keyDown", "value": code} for code in codes]
        presses += [{"type": "keyUp", "value": code} for code in reversed(codes)]
        self._act({"type": "key", "id": "keys", "actions": presses})

    def drag(self, way: list[tuple[float, float]]) -> None:
        """Move the mouse from the first point to the last with its button down."""
        moves = [
            {"type": "pointerMove", "x": round(x), "y": round(y), "origin": "viewport", "duration": 0}
            for x, y in way
        ]
        down, up = {"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}
        actions = [moves[0], down, *moves[1:], up]
        self._act(
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}
        )

    def _act(self, source: dict[str, Any]) -> None:
        self._call("WebDriver:PerformActions", {"actions": [source]})
        self.frame()

    @property
    def messages(self) -> list[str]:
        """What the page has logged or thrown."""
        return list(self._in("chrome", _LOGGED))

    @property
    def loaded(self) -> list[str]:
        """What the page has loaded beside itself."""
        return list(self.value("performance.getEntriesByType('resource').map(one => one.name)"))


@contextmanager
def second_browser(folder: Path) -> Iterator[SecondPage]:
    """Give a page of a new Firefox, which keeps what it keeps in a folder, and end it."""
    assert FIREFOX
    with socket.socket() as spare:
        spare.bind(("127.0.0.1", 0))
        port = spare.getsockname()[1]
    wishes = {
        "marionette.port": port,
        "ui.prefersReducedMotion": 1,
        "browser.shell.checkDefaultBrowser": False,
    }
    lines = [f"user_pref({json.dumps(name)}, {json.dumps(value)});\n" for name, value in wishes.items()]
    (folder / "user.js").write_text("".join(lines), encoding="utf-8")
    words = [
        FIREFOX,
        "--headless",
        "--marionette",
        "--remote-allow-system-access",
        "--no-remote",
        "--profile",
        str(folder),
        "about:blank",
    ]
    home = {**os.environ, "HOME": str(folder)}
    with subprocess.Popen(words, env=home, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT) as process:
        try:
            with _connected(port) as link:
                yield SecondPage(link)
        finally:
            process.terminate()
            process.wait(_PATIENCE)


def _connected(port: int) -> socket.socket:
    """Return a connection to the browser as soon as it takes one."""
    end = time.monotonic() + _PATIENCE
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), _PATIENCE)
        except ConnectionRefusedError:
            assert time.monotonic() < end, "the browser does not answer"
            time.sleep(0.1)
