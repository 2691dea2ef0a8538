"""Which program serves the page, and in which browser is it looked at?"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

Open = Callable[..., Page]

# A debug build on a machine that does other work, too, is slow; what is awaited comes all the same.
expect.set_options(timeout=60_000)


@pytest.fixture(scope="session")
def origin() -> Iterator[str]:
    """The address at which the program serves, as it tells it."""
    program = os.environ.get("STIFFARM_PROGRAM", "target/debug/stiffarm")
    served = subprocess.Popen([program, "serve"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    output = ""
    assert served.stdout is not None
    for line in served.stdout:
        output += line
        if found := re.search(r"http://127\.0\.0\.1:\d+", line):
            yield found[0]
            break
    else:
        pytest.fail(f"`stiffarm serve` printed no address: {output}")
    served.terminate()
    served.wait(timeout=20)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Chromium without a window: a shell that draws pages and no more starts and opens them in half the time."""
    names = ["chromium-headless-shell", "chromium", "chromium-browser"]
    found = next((path for name in names if (path := shutil.which(name))), None)
    if found is None:
        pytest.fail("no chromium: apt-get install chromium-headless-shell, or chromium")
    with sync_playwright() as driver:
        window = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        yield window
        window.close()


@pytest.fixture
def look(browser: Browser, origin: str) -> Iterator[Open]:
    """Opens the page; at the end of every test nothing was wrong in the console, and nothing outside was asked."""
    faults: list[str] = []
    contexts = []

    def opened(address: str = "#robots", *, width: int = 1280, height: int = 900, refused: bool = False, dark: bool = False) -> Page:
        context = browser.new_context(
            viewport={"width": width, "height": height}, color_scheme="dark" if dark else "light", permissions=["clipboard-read", "clipboard-write"]
        )
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda error: faults.append(str(error)))
        # A refusal of the server is an answer; the browser's console calls every 4xx an error.
        page.on("console", lambda said: faults.append(said.text) if said.type == "error" and not (refused and "Failed to load resource" in said.text) else None)
        page.on("request", lambda asked: None if asked.url.startswith((origin, "blob:", "data:")) else faults.append(f"asks {asked.url}"))
        page.goto(f"{origin}/{address}")
        settled(page)
        return page

    yield opened
    for context in contexts:
        context.close()
    assert faults == []


def until(page: Page, condition: str) -> None:
    """Waits until a condition holds in the page, looked at with every picture; the strict policy forbids what `wait_for_function` does."""
    page.evaluate(
        f"""() => new Promise((done, fail) => {{
            const late = performance.now() + 60_000;
            const look = () => ({condition}) ? done(null) : performance.now() < late ? requestAnimationFrame(look) : fail(new Error("never came true"));
            look();
        }})"""
    )


def settled(page: Page) -> None:
    """Waits until the question that is asked is answered."""
    page.locator("#decide .verdict").first.wait_for(state="attached")
    page.locator("body:not([data-later]):not([aria-busy])").wait_for()
