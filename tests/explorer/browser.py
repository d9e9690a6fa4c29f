"""A headless Chromium, driven by its DevTools protocol through a pipe.

Its names resolve to nothing: a page that asks the network gets nothing, and DevTools tells of it.
"""

import json
import os
import subprocess

OPTIONS = (
    "--headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --remote-debugging-pipe about:blank"
)
LOCAL = ("file:", "data:", "blob:", "about:", "chrome-extension:", "chrome:")


class Browser:
    """A tab of a browser, and all events that the browser told of."""

    def __init__(self, command, profile):
        questions, self.out = os.pipe()
        self.answers, replies = os.pipe()
        self.process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{questions} 4>&{replies}', "-", command, *OPTIONS.split()]
            + [f"--user-data-dir={profile}", "--host-resolver-rules=MAP * ~NOTFOUND"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            pass_fds=(questions, replies),
        )
        os.close(questions)
        os.close(replies)
        self.session, self.count, self.buffer, self.events = {}, 0, bytearray(), []
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        attached = self.ask("Target.attachToTarget", targetId=target, flatten=True)
        self.session = {"sessionId": attached["sessionId"]}
        for domain in ("Runtime", "Log", "Network", "Page"):
            self.ask(f"{domain}.enable")

    def close(self):
        self.process.terminate()
        self.process.wait()

    def ask(self, method, **params):
        """Send a command and return its result; events that come first are kept."""
        self.count += 1
        command = {"id": self.count, "method": method, "params": params} | self.session
        os.write(self.out, json.dumps(command).encode() + b"\0")
        while (answer := self.next_message()).get("id") != command["id"]:
            pass
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def next_message(self):
        while b"\0" not in self.buffer and (part := os.read(self.answers, 2**20)):
            self.buffer += part
        message, _, self.buffer = self.buffer.partition(b"\0")
        message = json.loads(message)
        self.events += [message] if "method" in message else []
        return message

    def after(self, does, event):
        """Do something, wait for an event of this kind, and return what it tells."""
        seen = len(self.events)
        does()
        while event not in (kinds := [heard["method"] for heard in self.events[seen:]]):
            self.next_message()
        return self.events[seen + kinds.index(event)]["params"]

    def do(self, script, *values):
        """Evaluate a script of the page, with values put in as JSON, and return what it gives."""
        for place, value in enumerate(values):
            script = script.replace(f"{{{place}}}", json.dumps(value))
        how = {"awaitPromise": True, "returnByValue": True}
        answer = self.ask("Runtime.evaluate", expression=script, **how)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']['exception']}")
        return answer["result"].get("value")

    @property
    def requests(self):
        """The addresses that were asked of the network."""
        sent = [e["params"] for e in self.events if e["method"] == "Network.requestWillBeSent"]
        return [url for e in sent if not (url := e["request"]["url"]).startswith(LOCAL)]

    @property
    def errors(self):
        """What went wrong: exceptions, and errors of the console and of the log."""
        return [
            event["params"]
            for event in self.events
            if event["method"] == "Runtime.exceptionThrown"
            or event["params"].get("type") in ("error", "assert")
            or event["params"].get("entry", {}).get("level") == "error"
        ]
