"""Take the still of the page to play with that the README shows."""

import asyncio
from pathlib import Path

from replication.commands.check_html import BROWSERS, Tab, find_browser, opened

WIDTH, HEIGHT = 1440, 900
TIME = 2.6  # s: the first case, before anything has fallen
SETTLED = """new Promise(resolve => {
  const look = () => {
    const isDone = document.documentElement.dataset.spectrum === "done";
    if (isDone && !document.querySelector(".pending")) resolve(true);
    else setTimeout(look, 50);
  };
  look();
})"""


async def _take(tab: Tab, page: Path, picture: Path) -> None:
    await tab.open("about:blank")
    size = {"width": WIDTH, "height": HEIGHT, "deviceScaleFactor": 1, "mobile": False}
    await tab.ask("Emulation.setDeviceMetricsOverride", **size)
    tab.loaded = False
    await tab.ask("Page.navigate", url=page.resolve().as_uri())
    while not tab.loaded:
        await tab.next_message()
    await tab.do(SETTLED)
    await tab.do(f"pause(), show({TIME}), new Promise(resolve => setTimeout(resolve, 300))")
    await tab.picture(picture)


def still(page: Path, picture: Path) -> None:
    """Write a PNG of a page, or say that the old one is kept, as there is no browser."""
    browser = find_browser()
    if browser is None:
        print(f"{picture}: not taken anew, since none of {', '.join(BROWSERS)} is on the PATH")
        return

    async def take() -> None:
        async with opened(browser) as tab:
            await _take(tab, page, picture)

    asyncio.run(take())
