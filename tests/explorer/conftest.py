"""The page to play with, put together anew and opened in a headless browser."""

import shutil
from pathlib import Path

import pytest

from documents.explorer import page
from tests.explorer.browser import Browser
from topheavy import read_record

ROOT = Path(__file__).parents[2]
WAIT = """new Promise((resolve, reject) => {
  const deadline = Date.now() + 120000;
  const look = () => {
    const value = {0};
    if (value) resolve(value);
    else if (Date.now() > deadline) reject(new Error("not so after two minutes: {0}"));
    else setTimeout(look, 10);
  };
  look();
})"""
SHOWN = "document.documentElement.dataset.shown === encode(state)"
SETTLED = {
    "histories": SHOWN,
    "map": f"{SHOWN} && document.documentElement.dataset.spectrum === 'done'",
    "minima": f"{SHOWN} && !document.querySelector('.pending')",  # they come after the map
}
DROP = """(() => {
  const data = new DataTransfer();
  data.items.add(new File([{0}], {1}));
  dispatchEvent(new DragEvent("drop", {dataTransfer: data, cancelable: true}));
})()"""


class Page(Browser):
    """The page in a tab that is driven line by line."""

    kept = None

    def open(self, address="g=1", *, width=1440, height=900, moves=False, until="histories"):
        """Open the page at an address and at a size, in light colours.

        Unless it `moves`, it is shown to somebody who prefers that it does not.
        """
        self.visit("about:blank")
        self.events.clear()
        self.resize(width, height)
        preferred = {
            "prefers-color-scheme": "light",
            "prefers-reduced-motion": "" if moves else "reduce",
        }
        features = [{"name": name, "value": value} for name, value in preferred.items()]
        self.ask("Emulation.setEmulatedMedia", features=features)
        self.visit(self.address + (f"#{address}" if address else ""))
        self.settle(until)

    def open_once(self, address="g=1"):
        """Have the page at an address: it serves all tests in a row that do not change it."""
        if self.kept != address:
            self.open(address)
        self.kept = address

    def begin(self, change):
        """Show the state that differs from the usual one by a change, with all its numbers."""
        self.do("start({...DEFAULTS, ...{0}})", change)
        self.settle("minima")

    def resize(self, width, height):
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.ask("Emulation.setDeviceMetricsOverride", **size)

    def visit(self, url):
        self.kept = None
        self.after(lambda: self.ask("Page.navigate", url=url), "Page.loadEventFired")

    def wait(self, condition):
        """Wait until an expression of the page is true, and return it."""
        return self.do(
            WAIT.replace("{0}", condition, 1).replace("{0}", condition.replace('"', "'"))
        )

    def settle(self, until="histories"):
        """Wait until histories, the map or minima are those of the state."""
        self.wait(SETTLED[until])

    def drop(self, name, text):
        """Drop a file on the page, and return what it says of it: "" if it is read."""
        self.do(DROP, text, name)
        return self.said()

    def said(self):
        self.wait("!document.getElementById('reading').textContent")
        return self.do("document.getElementById('record-error').textContent")

    def choose(self, path, does):
        """Do what opens the browser's dialog of files, and choose one in it."""
        self.ask("Page.setInterceptFileChooserDialog", enabled=True)
        node = self.after(does, "Page.fileChooserOpened")["backendNodeId"]
        self.ask("DOM.setFileInputFiles", backendNodeId=node, files=[str(path)])
        self.ask("Page.setInterceptFileChooserDialog", enabled=False)

    def press(self, key, code, text=""):
        """Press a key of the keyboard, and let it go."""
        stroke = {"key": key, "code": key, "windowsVirtualKeyCode": code}
        down = {"type": "keyDown", "text": text} if text else {"type": "rawKeyDown"}
        self.ask("Input.dispatchKeyEvent", **down, **stroke)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **stroke)


@pytest.fixture(scope="session")
def records():
    path = ROOT / "data" / "records" / "el_centro_1940_NS.AT2"
    return {path.stem: read_record(path)}


@pytest.fixture(scope="session")
def text(records):
    return page(ROOT / "src/explorer", records)


@pytest.fixture(scope="session")
def browser(text, tmp_path_factory):
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    command = next(filter(None, map(shutil.which, names)), None)
    if command is None:
        pytest.skip(f"none of {', '.join(names)} is on the PATH")
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    file.write_text(text, encoding="utf-8", newline="\n")
    tab = Page(command, file.parent / "profile")
    tab.address = file.as_uri()
    yield tab
    tab.close()


@pytest.fixture(scope="session")
def square():
    """Return files of records that change sign after each half second."""

    def text(peak, step=0.02, number=200):
        period = round(0.5 / step)
        rows = (f"{k * step:.3f},{peak * (-1) ** (k // period)}\n" for k in range(number))
        return "time (s),acceleration (g)\n" + "".join(rows)

    return text
