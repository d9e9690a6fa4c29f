"""The page to play with, put together anew and opened in a headless browser."""

import shutil
from pathlib import Path

import pytest

from steps.explorer import page
from tests.explorer.browser import Browser
from topheavy import read_record

ROOT = Path(__file__).parents[2]
SETTLED = """new Promise((resolve, reject) => {
  const deadline = Date.now() + 120000;
  const look = () => {
    const { shown, spectrum } = document.documentElement.dataset, isShown = shown === encode(state);
    if (isShown && rested && {0} !== "histories") settle();
    const hasMinima = isShown && !document.querySelector(".pending");
    if ({histories: isShown, minima: hasMinima, spectrum: hasMinima && spectrum === "done"}[{0}]) {
      resolve(true);
    } else if (Date.now() > deadline) reject(new Error("not settled after two minutes"));
    else setTimeout(look, 10);
  };
  setTimeout(look, 20);
})"""

# Opens a file by {0}, and waits for what the page tells of it: "" if it is read.
READ = """new Promise((resolve, reject) => {
  const deadline = Date.now() + 60000, known = opened;
  const look = () => {
    const told = document.getElementById("record-error").textContent;
    if (told || opened > known) resolve(told);
    else if (Date.now() > deadline) reject(new Error("not read after a minute"));
    else setTimeout(look, 20);
  };
  {0};
  look();
})"""
DROP = """(() => {
  const data = new DataTransfer();
  data.items.add(new File([{0}], {1}));
  dispatchEvent(new DragEvent("drop", {dataTransfer: data, cancelable: true}));
})()"""


class Page(Browser):
    """The page in a tab that is driven line by line."""

    has_only_computed = False

    def open(
        self,
        address="g=1",
        *,
        width=1440,
        height=900,
        dark=False,
        moves=False,
        until="histories",
    ):
        """Open the page at an address, at a size and in a colour scheme. At "" it asks first.

        Unless it `moves`, it is shown to somebody who prefers that it does not. It is loaded anew
        in the same tab: its workers stop, and its code is not compiled again.
        """
        self.visit("about:blank")
        self.events.clear()
        self.resize(width, height)
        preferred = {
            "prefers-color-scheme": "dark" if dark else "light",
            "prefers-reduced-motion": "" if moves else "reduce",
        }
        features = [{"name": name, "value": value} for name, value in preferred.items()]
        self.ask("Emulation.setEmulatedMedia", features=features)
        self.load(address)
        if until:
            self.settle(until)

    def open_to_compute(self):
        """Have the page's functions: one page serves all tests in a row that only call these."""
        if not self.has_only_computed:
            self.open()
        self.has_only_computed = True

    def begin(self, change):
        """Show the state that differs from the usual one by a change, from its beginning."""
        self.do("start({...DEFAULTS, ...{0}})", change)
        self.settle("minima")

    def resize(self, width, height=900):
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.ask("Emulation.setDeviceMetricsOverride", **size)

    def load(self, address=""):
        """Load the page at an address in the tab as it is."""
        self.visit(self.address + (f"#{address}" if address else ""))

    def visit(self, url):
        self.has_only_computed = False
        self.after(lambda: self.ask("Page.navigate", url=url), "Page.loadEventFired")

    def choose(self, path):
        """Put a file from the disk into the page, as `chosen`, without opening it there."""
        made = "Object.assign(document.createElement('input'), {type: 'file'})"
        held = self.ask("Runtime.evaluate", expression=made)["result"]["objectId"]
        self.ask("DOM.setFileInputFiles", objectId=held, files=[str(path)])
        code = "function() { window.chosen = this.files[0]; }"
        self.ask("Runtime.callFunctionOn", objectId=held, functionDeclaration=code)

    def read(self, script="", *values):
        """Open a file by a script, and return what the page tells of it: "" if it is read."""
        return self.do(READ.replace("{0}", script), *values)

    def drop(self, name, text):
        """Drop a file on the page, and return what it tells of it."""
        return self.read(DROP, text, name)

    def answer(self, path, does):
        """Do what opens the browser's dialog of files, and choose one in it."""
        self.ask("Page.setInterceptFileChooserDialog", enabled=True)
        node = self.after(does, "Page.fileChooserOpened")["backendNodeId"]
        self.ask("DOM.setFileInputFiles", backendNodeId=node, files=[str(path)])
        self.ask("Page.setInterceptFileChooserDialog", enabled=False)

    def settle(self, until="histories"):
        """Wait until histories are those of the state, or minima, too, or the whole spectrum, too.

        The page's pause before it computes minima is left out.
        """
        self.do(SETTLED, until)


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
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None:
        pytest.skip(f"none of {', '.join(names)} is on the PATH")
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    file.write_text(text, encoding="utf-8", newline="\n")
    one = Page(found, file.parent / "profile")
    one.address = file.as_uri()
    yield one
    one.close()
