"""Where must the work stand? The zone in the hand."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from conftest import Open, settled, until

ZONE = "#look .over .zone"


def number(page: Page) -> float:
    return float(page.locator("#number").inner_text().split()[0])


def drag(page: Page, selector: str, dx: float, dy: float, *, let_go: bool = True) -> None:
    box = page.locator(selector).bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for part in range(1, 6):
        page.mouse.move(x + dx * part / 5, y + dy * part / 5)
    if let_go:
        page.mouse.up()


def test_the_value_follows_the_hand_and_best_place_jumps_back(look: Open) -> None:
    page = look("#place")
    best = number(page)
    drag(page, ZONE, 60, 0, let_go=False)
    expect(page.locator(".live")).to_contain_text("here")
    until(page, f"parseFloat(document.querySelector('#number').textContent) > {best} + 0.05")
    assert not re.search("[?&]at=", page.url), "before the hand lets go nothing is asked for good"
    page.mouse.up()
    page.wait_for_url("**at=**")
    settled(page)
    assert number(page) > best
    expect(page.locator(".live")).to_contain_text("best place")
    page.get_by_role("button", name="best place").click()
    until(page, f"parseFloat(document.querySelector('#number').textContent) === {best}")
    assert not re.search("[?&]at=", page.url)


def test_a_larger_zone_gives_way_more(look: Open) -> None:
    page = look("#place?task=circle:0.3")
    best = number(page)
    drag(page, "#look .over .handle", 30, -30)
    until(page, f"parseFloat(document.querySelector('#number').textContent) > {best}")
    task = page.get_by_label("task", exact=True).input_value()
    assert float(task.removeprefix("circle:")) > 0.3


def test_arrows_move_by_a_millimetre_and_with_shift_by_a_centimetre(look: Open) -> None:
    page = look("#place?at=1.5,0.7&angle=0")
    page.locator(ZONE).focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_url("**at=1.501%2C0.7*")
    page.keyboard.press("Shift+ArrowDown")
    page.wait_for_url("**at=1.501%2C0.69*")
    expect(page.locator(".live")).to_contain_text("x 1.501, z 0.690 m")
    assert page.locator(ZONE).evaluate("zone => zone === document.activeElement")


def test_the_zone_is_resized_and_turned_by_keys(look: Open) -> None:
    page = look("#place?at=1.5,0.7&angle=0")
    page.locator("#look .over .handle").focus()
    page.keyboard.press("ArrowRight")
    expect(page.get_by_label("task", exact=True)).to_have_value("rect:0.61x0.4")
    page.locator(ZONE).focus()
    page.keyboard.press("[")
    page.wait_for_url("**angle=5*")


def test_a_circle_has_no_angle(look: Open) -> None:
    page = look("#place?at=1.5,0.7&angle=0")
    page.get_by_label("task", exact=True).fill("circle:0.3")
    page.wait_for_url("**?at=1.5%2C0.7&task=circle%3A0.3")
    page.locator(ZONE).focus()
    page.keyboard.press("[")
    page.keyboard.press("ArrowRight")
    page.wait_for_url("**?at=1.501%2C0.7&task=circle%3A0.3")
    expect(page.locator(".live")).to_contain_text("x 1.501, z 0.700 m")


def test_in_space_the_side_that_is_seen_is_resized(look: Open) -> None:
    page = look("#place?model=spatial&force-n=400&tool=spindle:250@90&at=1.3,0.9&angle=0")
    page.locator("#look .over .handle").focus()
    page.keyboard.press("ArrowLeft")
    task = page.get_by_label("task", exact=True)
    expect(task).not_to_have_value("rect:0.6x0.4")
    sides = [float(side) for side in task.input_value().removeprefix("rect:").split("x")]
    assert sides in ([0.59, 0.4], [0.6, 0.39])


def test_what_is_not_reached_says_why(look: Open) -> None:
    page = look("#place?at=0.2,0.3", refused=True)
    expect(page.locator("#number")).to_contain_text("not reached")
    expect(page.locator(".live")).to_contain_text("why")
    expect(page.locator(ZONE)).to_have_attribute("data-state", "none")
    drag(page, ZONE, 120, -40)
    until(page, "document.querySelector('#number').textContent.endsWith(' mm')")


def test_only_what_does_not_hold_is_red(look: Open) -> None:
    page = look("#place?tolerance-mm=0.5")
    expect(page.locator(".live .fail")).to_have_count(1)
    expect(page.locator("#decide")).to_contain_text("largest force")
    page.get_by_label("tolerance [mm]").fill("4")
    expect(page.locator(".live .pass")).to_have_count(1)
    expect(page.locator(".fail")).to_have_count(0)


def test_an_option_that_is_refused_says_so_at_its_control(look: Open) -> None:
    page = look("#place", refused=True)
    page.get_by_label("task", exact=True).fill("cirkle:0.3")
    field = page.locator("[data-option=task]")
    expect(field.locator(".fault")).to_contain_text("cirkle")
    expect(field.locator("input")).to_have_attribute("aria-invalid", "true")
    page.get_by_label("task", exact=True).fill("circle:0.3")
    expect(field.locator(".fault")).to_be_empty()


@pytest.mark.parametrize("asked", ["#place", "#place?force-n=300,0,-80"])
def test_values_are_shown_under_the_pointer(look: Open, asked: str) -> None:
    page = look(asked)
    box = page.locator("#look .section .picture").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] * 0.66, box["y"] + box["height"] * 0.45)
    expect(page.locator(".tip")).to_contain_text(re.compile(r"^[0-9.]+ mm at x [0-9.-]+, z [0-9.-]+ m$"))


def test_a_view_in_space_comes_in_a_frame_of_its_own(look: Open) -> None:
    page = look("#place")
    page.get_by_role("button", name="in space", exact=True).first.click()
    frame = page.frame_locator("iframe[sandbox='allow-scripts']")
    expect(frame.locator(".js-plotly-plot, .plot-container").first).to_be_attached()


def test_the_architectures_are_drawn(look: Open) -> None:
    page = look("#place")
    page.get_by_role("button", name="architectures").click()
    until(page, "[...document.querySelectorAll('#look .picture')].some(image => image.alt.startsWith('serial against') && image.naturalWidth > 0)")


def test_the_robot_and_its_task_are_marked_among_the_architectures(look: Open) -> None:
    page = look("#place?task=rect:0.6x0.4")
    with page.expect_response("**/api/study**") as answered:
        page.get_by_role("button", name="architectures").click()
    asked = answered.value.request.post_data_json["options"]
    assert asked["task"] == "rect:0.6x0.4" and asked["robot"] == page.get_by_label("robot", exact=True).input_value()
    # A stream that the page has read is gone: the same is asked once more.
    drawn = page.request.post(answered.value.url, data=answered.value.request.post_data_json).json()["svg"]
    assert f"{asked['robot']}, were it quasi-serial" in drawn
    settled(page)


EDGE = "#look .window .grip >> nth={}"


def test_an_edge_of_the_window_pushes_the_best_place(look: Open) -> None:
    page = look("#place?at=1.6,0.7&angle=0")
    page.get_by_role("button", name="best place").click()
    until(page, "!location.hash.includes('at=')")
    settled(page)
    best = number(page)
    stands = page.locator(ZONE).get_attribute("aria-label")
    drag(page, EDGE.format(0), 140, 0, let_go=False)
    until(page, f"parseFloat(document.querySelector('#number').textContent) > {best}")
    expect(page.locator(ZONE)).not_to_have_attribute("aria-label", stands or "")
    expect(page.locator(".live")).to_contain_text("at its best place")
    assert "within" not in page.url, "before the hand lets go nothing is asked for good"
    page.mouse.up()
    page.wait_for_url("**within=*")
    settled(page)
    given = page.get_by_label("within", exact=True).input_value()
    found = re.fullmatch(r"([0-9.]+)\.\.,\.\.", given)
    assert found, given
    assert number(page) > best
    x = re.search(r"stands at\s*x ([0-9.-]+)", page.locator(".live").inner_text())
    assert x is not None
    assert float(x[1]) > float(found[1])


def test_the_window_is_moved_and_opened_by_keys(look: Open) -> None:
    page = look("#place?within=0.9..,..1.4&at=1.6,0.7")
    page.locator(EDGE.format(3)).focus()
    page.keyboard.press("ArrowDown")
    page.wait_for_url("**within=0.9..%2C..1.39")
    page.keyboard.press("Shift+ArrowUp")
    page.wait_for_url("**within=0.9..%2C..1.49")
    page.keyboard.press("Delete")
    page.wait_for_url("**within=0.9..%2C..")
    expect(page.locator(EDGE.format(3))).to_have_attribute("aria-valuetext", "open")
    expect(page.locator(EDGE.format(0))).to_have_attribute("aria-valuetext", "0.9 m")


def test_behind_a_mount_the_window_has_no_edges(look: Open) -> None:
    page = look("#place?mount=pedestal:0.5")
    expect(page.locator("#look .window")).to_have_attribute("display", "none")


def test_what_may_not_be_carried_is_red_wherever_it_is_seen(look: Open) -> None:
    page = look("#place?task=A:0.3&force-n=3000&tolerance-mm=50")
    expect(page.locator(".verdict .number b")).to_have_text("load exceeded")
    expect(page.locator(".verdict .number b")).to_have_class("fail")
    assert page.locator("#look [data-state]").first.get_attribute("data-state") == "fail"
    # Nor without a tolerance.
    expect(look("#place?task=A:0.3&force-n=3000").locator(".verdict .number b")).to_have_text("load exceeded")


def test_what_may_touch_is_said_on_the_page_too(look: Open) -> None:
    page = look("#place?model=spatial&task=rect:0.3x0.2&tool=spindle:250@90")
    expect(page.locator("#decide")).to_contain_text("nine arms in ten")
