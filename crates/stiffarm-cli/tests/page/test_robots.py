"""Which robot? What a person does in the first view."""

from __future__ import annotations

from playwright.sync_api import expect

from conftest import Open


def test_the_first_question_is_answered_without_a_click(look: Open) -> None:
    page = look("")
    expect(page.locator("nav a[aria-current]")).to_contain_text("Robots")
    assert page.locator(".ranking tbody tr").count() == 10
    assert page.locator("#look .picture").first.evaluate("image => image.naturalWidth") > 0
    expect(page.locator("#decide .verdict")).to_contain_text("1 urad/(N m) assumed on every drive")


def test_the_ranking_follows_what_is_typed(look: Open) -> None:
    page = look("#robots")
    page.get_by_label("tolerance [mm]").fill("1.9")
    expect(page.locator(".ranking")).to_contain_text("fail")
    expect(page.locator(".ranking")).to_contain_text("pass")
    assert "tolerance-mm=1.9" in page.url


def test_robots_are_found_in_the_whole_catalogue_and_chosen_by_keys(look: Open) -> None:
    page = look("#robots")
    search = page.get_by_role("combobox", name="robots")
    search.press_sequentially("bt200")
    expect(page.get_by_role("option").first).to_contain_text("BT200L")
    search.press("ArrowDown")
    search.press("Enter")
    expect(page.locator(".ranking tbody tr")).to_have_count(1)
    search.press_sequentially("6650S-200")
    expect(page.get_by_role("option").first).to_contain_text("IRB 6650S-200")
    search.press("ArrowDown")
    search.press("Enter")
    expect(page.locator(".ranking tbody tr")).to_have_count(2)
    page.get_by_role("button", name="leave out BT200L").click()
    expect(page.locator(".ranking tbody tr")).to_have_count(1)
    expect(page.locator(".ranking")).to_contain_text("IRB 6650S-200")


def test_columns_sort_and_tell_so(look: Open) -> None:
    page = look("#robots")
    column = page.locator(".ranking thead button", has_text="bound")
    place = 1 + page.locator(".ranking thead th").all_inner_texts().index("bound")
    bounds = page.locator(f".ranking tbody tr td:nth-child({place})")
    column.click()
    rising = [float(text) for text in bounds.all_inner_texts()]
    assert rising == sorted(rising)
    column.click()
    assert [float(text) for text in bounds.all_inner_texts()] == rising[::-1]
    expect(page.locator(".ranking th[aria-sort=descending]")).to_have_count(1)


def test_two_robots_stand_side_by_side(look: Open) -> None:
    page = look("#robots")
    page.get_by_role("button", name="add BT200L to compare").click()
    page.get_by_role("button", name="add IRB 6650S-200 to compare").click()
    compared = page.get_by_role("region", name="two setups side by side")
    expect(compared).to_contain_text("At the nominal stiffness")
    expect(compared.locator(".picture")).to_have_count(1)


def test_a_robot_of_the_ranking_is_placed(look: Open) -> None:
    page = look("#robots?task=A:0.3")
    page.get_by_role("button", name="place the work at BT200L").click()
    expect(page.locator("nav a[aria-current]")).to_contain_text("Place")
    expect(page.get_by_role("combobox", name="robot", exact=True)).to_have_value("BT200L")
    expect(page.get_by_label("task", exact=True)).to_have_value("A:0.3")
    expect(page.locator("#number")).to_contain_text("1.9410 mm")


def test_a_bad_robot_file_is_reported_with_its_lines_and_not_used(look: Open) -> None:
    page = look("#place", refused=True)
    before = page.url
    bad = {"name": "bad.toml", "mimeType": "text/plain", "buffer": b'name = "x"\n[planar]\nl2_mm = -5\n'}
    page.get_by_label("open a robot file for robot").and_(page.locator("input")).set_input_files(files=[bad])
    checked = page.locator(".checked")
    expect(checked).to_contain_text("bad.toml cannot be used")
    expect(checked).to_contain_text("line 3")
    expect(checked).to_contain_text("-5 mm; expected 20 to 10000 mm")
    assert page.url == before


def test_a_good_robot_file_is_used_at_once(look: Open) -> None:
    page = look("#place?task=A:0.3")
    text = b'name = "two links"\narchitecture = "serial"\nstatus = "derived"\n[planar]\nl2_mm = 1000\nl3_mm = 800\n'
    page.get_by_label("open a robot file for robot").and_(page.locator("input")).set_input_files(files=[{"name": "mine.toml", "mimeType": "text/plain", "buffer": text}])
    expect(page.get_by_role("combobox", name="robot", exact=True)).to_have_value("mine.toml")
    expect(page.locator("#look .picture").first).to_be_visible()
    expect(page.locator("#number")).to_contain_text("mm")
    expect(page.locator("#fault")).to_be_empty()
