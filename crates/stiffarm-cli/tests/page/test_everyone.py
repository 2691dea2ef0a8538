"""Can everyone use it? Labels, keys, contrast, narrow windows, dark rooms."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from conftest import Open

VIEWS = ["robots", "place", "mill", "measure?measure.runs=6&measure.candidates=200", "calibrate"]

UNNAMED = """() => [...document.querySelectorAll('input, select, button, a[href], [tabindex="0"]')]
    .filter(element => !(element.labels?.length || element.getAttribute('aria-label') || element.textContent.trim()))
    .map(element => element.outerHTML.slice(0, 120))"""

FAINT = """() => {
    const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    const rgb = colour => { canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1); return [...canvas.getImageData(0, 0, 1, 1).data]; };
    const light = ([r, g, b]) => { const [x, y, z] = [r, g, b].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4); return 0.2126 * x + 0.7152 * y + 0.0722 * z; };
    const ground = element => { for (let at = element; at; at = at.parentElement) { const colour = rgb(getComputedStyle(at).backgroundColor); if (colour[3] === 255) return colour; } return [255, 255, 255, 255]; };
    return [...document.querySelectorAll('body *')]
        .filter(element => element.checkVisibility() && !element.disabled && [...element.childNodes].some(node => node.nodeType === 3 && node.data.trim()))
        .map(element => { const [a, b] = [light(rgb(getComputedStyle(element).color)), light(ground(element))]; return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), element.outerHTML.slice(0, 100)]; })
        .filter(([ratio]) => ratio < 4.5);
}"""


@pytest.mark.parametrize("view", VIEWS)
def test_everything_that_takes_a_hand_has_a_name(look: Open, view: str) -> None:
    page = look(f"#{view}")
    page.locator("#ask details summary").first.click()
    assert page.evaluate(UNNAMED) == []
    identical = page.evaluate("() => { const ids = [...document.querySelectorAll('[id]')].map(e => e.id); return ids.filter((id, i) => ids.indexOf(id) !== i); }")
    assert [name for name in identical if name != "number"] == []


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("view", VIEWS)
def test_text_stands_out_from_its_ground(look: Open, view: str, dark: bool) -> None:
    page = look(f"#{view}", dark=dark)
    assert page.evaluate(FAINT) == []


@pytest.mark.parametrize("view", VIEWS)
def test_a_narrow_window_is_not_wider_than_it_is(look: Open, view: str) -> None:
    page = look(f"#{view}", width=360, height=800)
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    expect(page.locator("#decide .verdict").first).to_be_visible()


def test_the_tab_key_goes_as_the_eye_goes(look: Open) -> None:
    page = look("#place")
    order = []
    for _ in range(40):
        page.keyboard.press("Tab")
        order.append(page.evaluate("(document.activeElement.closest('header, #asked, #look, #decide') ?? {}).id ?? 'header'"))
    met = [name for name in ["asked", "look", "decide"] if name in order]
    assert met == ["asked", "look", "decide"]
    firsts = [order.index(name) for name in met]
    assert firsts == sorted(firsts)


def test_values_are_said_to_those_who_do_not_see(look: Open) -> None:
    page = look("#place")
    expect(page.locator("#status[role=status]")).to_contain_text("mm")
    expect(page.locator(".live")).to_have_attribute("aria-live", "polite")


def test_the_policy_lets_nothing_in(look: Open, origin: str) -> None:
    page = look("#robots")
    policy = page.request.get(f"{origin}/").headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "unsafe-eval" not in policy
    scripts = policy.split("script-src")[1].split(";")[0]
    assert "unsafe-inline" not in scripts


SMALL = """() => [...document.querySelectorAll('button, select, summary, nav a, input:not([type=checkbox], [type=file])')]
    .filter(element => element.checkVisibility() && !element.closest('.opener'))
    .map(element => [element.getBoundingClientRect().height, element.outerHTML.slice(0, 100)])
    .filter(([height]) => height < 44)"""


@pytest.mark.parametrize("view", VIEWS)
def test_on_a_phone_the_answer_stands_first_and_everything_is_as_large_as_a_finger(look: Open, view: str) -> None:
    page = look(f"#{view}", width=390, height=844)
    tops = [page.locator(f"#{name}").bounding_box()["y"] for name in ("decide", "look", "asked")]
    assert tops == sorted(tops)
    assert page.locator("#decide .verdict").first.bounding_box()["y"] < 844
    assert page.evaluate(SMALL) == []
