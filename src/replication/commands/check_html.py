"""Open the HTML report in a browser and look at every result in it: the end of `make html`.

The browser is driven by its own DevTools protocol. Its names resolve to nothing, so that
a page that asks the network gets nothing, and DevTools tells of its requests.
"""

import asyncio
import base64
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import AsyncIterator, Iterable
from contextlib import asynccontextmanager
from pathlib import Path

from tornado.websocket import WebSocketClientConnection, websocket_connect

from replication.inputs.parts import PAPER, captions_of
from replication.inputs.strict_yaml import read_yaml
from replication.pages.captions import read_captions

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-port=0",
    "--window-size=1600,1000",
)
NO_NETWORK = "--host-resolver-rules=MAP * ~NOTFOUND"
LOCAL = ("file:", "data:", "blob:", "about:", "chrome-extension:", "chrome:")
PATIENCE = 180.0  # s, for one answer of the browser
LARGEST_MESSAGE = 2**28  # bytes

RESULTS = """Promise.all(Object.entries(results).map(async ([path, entry]) => {
  const image = new Image();
  image.src = entry.data_uri;
  await image.decode().catch(() => 0);
  const said = new DOMParser().parseFromString(entry.caption, "text/html").body.textContent;
  return [path, entry.data_uri, entry.caption, said, image.naturalWidth];
}))"""
"""What the page holds: of each result its file, its caption as HTML and as text, its width."""


class Tab:
    """A tab of a headless browser, and what went wrong in it."""

    def __init__(self, socket: WebSocketClientConnection):
        self.socket, self.session, self.count = socket, {}, 0
        self.target: str | None = None
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.loaded = False

    async def ask(self, method: str, **params):
        """Send a command and return its result; events that come first are noted."""
        self.count += 1
        number = self.count
        await self.socket.write_message(
            json.dumps({"id": number, "method": method, "params": params} | self.session)
        )
        while True:
            answer = await self.next_message()
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    async def next_message(self) -> dict:
        text = await asyncio.wait_for(self.socket.read_message(), PATIENCE)
        if text is None:
            raise RuntimeError("the browser closed the connection")
        message = json.loads(text)
        self.note(message.get("method"), message.get("params", {}))
        return message

    def note(self, event: str | None, params: dict) -> None:
        """Keep what an event tells of errors and of requests to the network."""
        if event == "Network.requestWillBeSent":
            url = params["request"]["url"]
            if not url.startswith(LOCAL):
                self.requests.append(url)
        elif event == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description") or details["text"])
        elif event == "Runtime.consoleAPICalled" and params["type"] in ("error", "assert"):
            self.errors.append(" ".join(str(arg.get("value")) for arg in params["args"]))
        elif event == "Log.entryAdded" and params["entry"]["level"] == "error":
            self.errors.append(params["entry"]["text"])
        elif event == "Page.loadEventFired":
            self.loaded = True

    async def open(self, url: str) -> None:
        """Open a page in a new tab; the one before is closed, so that its workers stop."""
        before, self.session, self.loaded = self.target, {}, False
        self.target = (await self.ask("Target.createTarget", url="about:blank"))["targetId"]
        if before:
            await self.ask("Target.closeTarget", targetId=before)
        attached = await self.ask("Target.attachToTarget", targetId=self.target, flatten=True)
        self.session = {"sessionId": attached["sessionId"]}
        for domain in ("Runtime", "Log", "Network", "Page"):
            await self.ask(f"{domain}.enable")
        await self.ask("Page.navigate", url=url)
        while not self.loaded:
            await self.next_message()

    async def do(self, script: str, *values):
        """Evaluate a script of the page, with values put in as JSON, and return what it gives."""
        for place, given in enumerate(values):
            script = script.replace(f"{{{place}}}", json.dumps(given))
        answer = await self.ask(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True
        )
        if "exceptionDetails" in answer:
            thrown = answer["exceptionDetails"]["exception"]
            raise RuntimeError(f"{script}: {thrown['description']}")
        return answer["result"].get("value")

    async def leave(self) -> None:
        """Close the connection, and wait until it is closed."""
        self.socket.close()
        while await self.socket.read_message() is not None:
            pass

    async def picture(self, path: Path) -> None:
        data = (await self.ask("Page.captureScreenshot", format="png"))["data"]
        path.write_bytes(base64.b64decode(data))


async def look(tab: Tab, page: Path, captions: dict[str, dict]) -> list[str]:
    """Look at every captioned result, and return the faults that were found."""
    await tab.open(page.resolve().as_uri())
    held = {path: rest for path, *rest in await tab.do(RESULTS)}
    faults = [f"{path} is not in the report" for path in sorted(set(captions) - set(held))]
    opening = await tab.do(
        "typeof metadata === 'object' && Object.keys(metadata).length ? workflow_desc : ''"
    )
    if not opening or "system-message" in opening:
        faults.append("the report does not open on a sound text (opening.rst)")
    faults += [f"{path} has no caption" for path in sorted(set(held) - set(captions))]
    for path in sorted(set(held) & set(captions)):
        uri, caption, said, width = held[path]
        if base64.b64decode(uri.partition("base64,")[2]) != Path(path).read_bytes():
            faults.append(f"{path} in the report is not what the workflow wrote")
        if not width > 0:
            faults.append(f"{path} cannot be drawn")
        if "system-message" in caption:
            faults.append(f"the caption of {path} is no sound reStructuredText")
        for part in ("caption", "alt"):
            if " ".join(captions[path].get(part, "").split()) not in " ".join(said.split()):
                faults.append(f"the {part} of {path} is not in the report")
    return faults


@asynccontextmanager
async def opened(browser: str) -> AsyncIterator[Tab]:
    """Start a headless browser without a network, and yield a tab of it."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = subprocess.Popen(
            [browser, *OPTIONS, NO_NETWORK, f"--user-data-dir={profile}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            port, path = await address(Path(profile, "DevToolsActivePort"), process)
            socket = await websocket_connect(
                f"ws://127.0.0.1:{port}{path}", max_message_size=LARGEST_MESSAGE
            )
            tab = Tab(socket)
            yield tab
            await tab.leave()
        finally:
            process.terminate()
            process.wait()


async def inspect(browser: str, page: Path, captions: dict[str, dict]) -> list[str]:
    """Open the page in a browser and return every fault, errors and requests included."""
    async with opened(browser) as tab:
        faults = await look(tab, page, captions)
    faults += [f"asks the network for {url}" for url in dict.fromkeys(tab.requests)]
    return faults + [f"error in the console: {error}" for error in dict.fromkeys(tab.errors)]


async def address(file: Path, process: subprocess.Popen) -> list[str]:
    """Wait for the browser to say on which port and path it listens."""
    for _ in range(round(PATIENCE / 0.1)):
        if file.exists() and len(lines := file.read_text(encoding="utf-8").split()) == 2:
            return lines
        if process.poll() is not None:
            raise RuntimeError(f"the browser ended at once, with {process.returncode}")
        await asyncio.sleep(0.1)
    raise RuntimeError(f"the browser did not say within {PATIENCE:.0f} s where it listens")


def find_browser(names: Iterable[str] = BROWSERS) -> str | None:
    """Return the first Chromium or Chrome on the PATH."""
    return next(filter(None, map(shutil.which, names)), None)


def main(page: Path, captions: dict[str, dict]) -> None:
    browser = find_browser()
    if browser is None:
        print(f"{page}: made, but not looked at: none of {', '.join(BROWSERS)} is on the PATH")
        return
    faults = asyncio.run(inspect(browser, page, captions))
    if faults:
        raise SystemExit("\n".join(f"{page}: {fault}" for fault in faults))
    print(f"{page}: {len(captions)} results drawn, no error, no request to the network")


if __name__ == "__main__":
    config = read_yaml("config/config.yaml")
    main(Path(sys.argv[1]), read_captions(map(captions_of, [PAPER, *config["studies"]])))
