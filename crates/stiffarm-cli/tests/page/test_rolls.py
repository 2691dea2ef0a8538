"""A path in the hand: the roll of the tool is pinned on the map of all rolls, the part is dragged through the cell."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from conftest import Open, settled

PIN = "#look .over .pin"
LINE = "mill.at=1.7,0,0.8,0&mill.path=line:0.2&robot=KR+210+R2700+extra&tool=spindle:250@90"


def number(page: Page) -> float:
    """What the verdict says, mm."""
    return float(page.locator("#number").inner_text().split()[0])


def pins(page: Page) -> str:
    return page.get_by_label("pin", exact=True).input_value()


def test_a_roll_is_pinned_moved_dragged_and_let_go(look: Open) -> None:
    page = look("#mill")
    settled(page)
    free = number(page)
    page.get_by_role("button", name="pin a roll").click()
    expect(page.locator(PIN)).to_have_count(1)
    settled(page)
    expect(page.locator("#decide")).to_contain_text("roll pinned to")
    assert number(page) > 0.99 * free
    before = pins(page)

    page.locator(PIN).focus()
    page.keyboard.press("Shift+ArrowUp")
    expect(page.get_by_label("pin", exact=True)).not_to_have_value(before)
    settled(page)
    way, roll = (float(part) for part in pins(page).split("@"))
    assert (way, (roll - float(before.split("@")[1])) % 360) == (float(before.split("@")[0]), 10)
    assert page.locator(PIN).evaluate("pin => pin === document.activeElement")

    box = page.locator(PIN).bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 40, y + 4, steps=4)
    page.mouse.up()
    settled(page)
    assert float(pins(page).split("@")[0]) < way

    page.mouse.click(x + 60, y)
    expect(page.locator(PIN)).to_have_count(2)
    settled(page)
    # Clicked at the height of the first, which was let go there: the same roll, to the pixels.
    first, second = (float(pin.split("@")[1]) for pin in pins(page).split(","))
    assert abs(first - second) < 15
    page.locator(PIN).nth(1).focus()
    page.keyboard.press("Delete")
    expect(page.locator(PIN)).to_have_count(1)
    page.get_by_role("button", name="no pins").click()
    expect(page.locator(PIN)).to_have_count(0)
    settled(page)
    assert number(page) == free


def test_a_pin_that_nothing_holds_can_be_taken_away_again(look: Open) -> None:
    page = look(f"#mill?{LINE}")
    settled(page)
    before = number(page)
    page.get_by_label("pin", exact=True).fill("100@0")
    expect(page.locator("#number")).to_contain_text("not followed")
    expect(page.locator(".verdict")).to_contain_text("no posture holds the roll that is pinned here")
    expect(page.locator(PIN)).to_have_count(1)
    page.locator(PIN).focus()
    page.keyboard.press("Delete")
    expect(page.locator("#number")).to_contain_text(f"{before:.4f} mm")


def test_the_part_is_dragged_lifted_and_turned_in_the_cell(look: Open) -> None:
    page = look(f"#mill?milled=cell&{LINE}")
    settled(page)
    before = number(page)
    part = page.locator("#look .over .zone:visible")
    box = part.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 10, y - 10, steps=3)
    page.mouse.up()
    stands = page.get_by_label("at [m, or deg of yaw]").or_(page.get_by_label("at", exact=True)).first
    expect(stands).not_to_have_value("1.7,0,0.8,0")
    settled(page)
    ahead, left, up, yaw = (float(part) for part in stands.input_value().split(","))
    assert ahead < 1.7 and 0 < left and (up, yaw) == (0.8, 0)
    assert number(page) != before
    part.focus()
    page.keyboard.press("PageUp")
    page.keyboard.press("[")
    settled(page)
    expect(stands).to_have_value(re.compile(",0.81,5$"))
    assert part.evaluate("part => part === document.activeElement")
