"""Take the stills of the page to play with, one a size of screen: `make stills`.

The README shows that of the largest.
"""

import asyncio
from pathlib import Path

from replication.commands.check_html import BROWSERS, Tab, find_browser, opened

SIZES = {"": (1440, 900), "_tablet": (820, 1180), "_phone": (390, 844)}
"""Of the screens, by what the name of the picture adds to that of the page."""
CASE = "#g=1"  # with which the page requests no guess
TIME = 2.6  # s: the first case, before anything has fallen
SETTLED = """new Promise(resolve => {
  const look = () => {
    const isDone = document.documentElement.dataset.spectrum === "done";
    if (isDone && !document.querySelector(".pending")) resolve(true);
    else setTimeout(look, 50);
  };
  look();
})"""


async def _take(tab: Tab, page: Path, picture: Path, width: int, height: int) -> None:
    await tab.open("about:blank")
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < height}
    await tab.ask("Emulation.setDeviceMetricsOverride", **size)
    tab.loaded = False
    await tab.ask("Page.navigate", url=page.resolve().as_uri() + CASE)
    while not tab.loaded:
        await tab.next_message()
    await tab.do(SETTLED)
    await tab.do(f"pause(), show({TIME}), new Promise(resolve => setTimeout(resolve, 300))")
    await tab.picture(picture)


def stills(page: Path) -> None:
    """Write the PNGs beside a page, or say that the old ones stay, as there is no browser."""
    browser = find_browser()
    if browser is None:
        print(f"{page}: no stills taken, since none of {', '.join(BROWSERS)} is on the PATH")
        return

    async def take() -> None:
        async with opened(browser) as tab:
            for name, size in SIZES.items():
                await _take(tab, page, page.with_name(f"{page.stem}{name}.png"), *size)

    asyncio.run(take())


if __name__ == "__main__":
    stills(Path("docs/explorer.html"))
