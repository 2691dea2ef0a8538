"""Milling and measuring, as they are done in the shop."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import expect

from conftest import Open, settled

EXAMPLES = Path(__file__).parents[4] / "docs" / "examples"
PATHS = Path(__file__).parents[3] / "stiffarm" / "tests" / "paths"


def test_a_path_that_is_built_in_is_milled(look: Open) -> None:
    page = look("#mill")
    expect(page.locator("#number")).to_contain_text("mm")
    expect(page.locator("#decide")).to_contain_text("lower bound of all rolls")
    page.get_by_label("tolerance [mm]").fill("0.1")
    expect(page.locator(".verdict .fail")).to_have_count(1)


def test_an_answer_is_computed_once_whatever_is_looked_at_of_it(look: Open) -> None:
    page = look("#robots")
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url.split("/api/")[1]) if request.method == "POST" and "/api/" in request.url else None)
    for view, forms in [("place?robot=BT200L&task=circle:0.3", "place?as=json,tables,svg"), ("mill", "mill?as=json,tables,svg,shop")]:
        asked.clear()
        page.goto(f"{page.url.split('#')[0]}#{view}")
        page.locator("#ask").get_by_label("tolerance [mm]").wait_for()
        settled(page)
        assert asked == [forms]
    page.get_by_role("button", name="in the cell").click()
    settled(page)
    expect(page.locator("#look .over .zone:visible")).to_have_count(1)
    page.get_by_role("button", name="rolls", exact=True).click()
    settled(page)
    assert asked == [forms]


def test_a_toolpath_and_a_process_are_opened_and_a_program_downloaded(look: Open) -> None:
    page = look("#mill?mill.at=1.7,0,0.8&robot=KR+210+R2700+extra&tool=spindle:250@90", refused=True)
    page.get_by_label("open a file for path").and_(page.locator("input")).set_input_files(PATHS / "contour_ij.nc")
    expect(page.get_by_label("path", exact=True)).to_have_value("contour_ij.nc")
    page.get_by_label("open a file for process").and_(page.locator("input")).set_input_files(EXAMPLES / "endmill.toml")
    # The force that was there as an example gives way.
    expect(page.locator("#number")).to_contain_text("0.2320 mm")
    page.get_by_label("compensate").check()
    with page.expect_download() as saved:
        page.get_by_role("button", name="download KUKA .src").click()
    assert b"DEF" in Path(saved.value.path()).read_bytes()


def test_whether_the_cuts_swing_is_reported_and_drawn_over_the_speed_of_the_spindle(look: Open) -> None:
    address = "#mill?mill.at=1.7,0,0.8&robot=KR+210+R2700-2&tool=spindle:250@90"
    page = look(address, refused=True)
    page.get_by_label("open a file for path").and_(page.locator("input")).set_input_files(PATHS / "contour_ij.nc")
    page.get_by_label("open a file for process").and_(page.locator("input")).set_input_files(EXAMPLES / "endmill.toml")
    page.get_by_label("force [N]").fill("")
    expect(page.get_by_role("button", name="chatter", exact=True)).to_have_count(0)
    page.get_by_label("chatter", exact=True).check()
    for words in ["spindle modes unknown", "fed the other way", "rolled otherwise", "chatter not covered"]:
        expect(page.locator("#decide")).to_contain_text(words)
    page.get_by_role("button", name="chatter", exact=True).click()
    lobes = page.get_by_alt_text("from which depth the worst cut swings, by the speed of the spindle")
    expect(lobes).to_be_visible()
    settled(page)
    assert lobes.evaluate("image => image.naturalWidth") > 300
    # Without the word the tab goes, and the rolls are shown.
    page.get_by_label("chatter", exact=True).uncheck()
    expect(lobes).to_be_hidden()
    expect(page.get_by_role("button", name="rolls", exact=True)).to_have_attribute("aria-pressed", "true")


def test_a_process_is_opened_with_the_table_of_forces_that_it_names(look: Open, tmp_path: Path) -> None:
    process, table = tmp_path / "sawn.toml", tmp_path / "forces.csv"
    process.write_text('[measured]\nfile = "forces.csv"\non = "tool"\n')
    table.write_text("s_m,f_feed_n,f_across_n,f_axial_n\n0,200,0,0\n9,200,0,0\n")
    address = "#mill?mill.at=1.7,0,0.8&robot=KR+210+R2700+extra&tool=spindle:250@90&mill.path=line:0.3&mill.force-n="
    page = look(f"{address}200,0,0")
    known = page.locator("#number").inner_text()
    page = look(address.replace("&mill.force-n=", ""), refused=True)
    page.get_by_label("open a file for process").and_(page.locator("input")).set_input_files([table, process])
    expect(page.get_by_label("process", exact=True)).to_have_value("sawn.toml")
    page.get_by_label("force [N]").fill("")
    expect(page.locator("#number")).to_have_text(known)


def test_postures_are_listed_and_a_table_to_fill_in_is_downloaded(look: Open) -> None:
    page = look("#measure?measure.runs=6&measure.candidates=200")
    expect(page.locator(".plan tbody tr")).to_have_count(6)
    with page.expect_download() as saved:
        page.get_by_role("button", name="download table to fill in").click()
    assert b"q1_deg" in Path(saved.value.path()).read_bytes()


def test_measurements_identify_a_robot_that_is_used_at_once(look: Open) -> None:
    page = look("#measure?measure.runs=6&measure.candidates=200&measure.load-mm=6.9,245.3,319.3")
    robot = page.get_by_label("open a robot file for robot").and_(page.locator("input"))
    robot.set_input_files(EXAMPLES / "fanuc_r2000ic.toml")
    expect(page.get_by_role("combobox", name="robot", exact=True)).to_have_value("fanuc_r2000ic.toml")
    settled(page)
    page.get_by_label("open the filled-in table").and_(page.locator("input")).set_input_files(EXAMPLES / "fanuc_r2000ic.csv")
    expect(page.get_by_role("region", name="drives as found").locator("tbody tr")).to_have_count(6)
    expect(page.locator("#number").first).to_contain_text("0.215 mm")
    settled(page)
    page.get_by_role("button", name="use this robot in the other views").click()
    expect(page.locator("nav a[aria-current]")).to_contain_text("Place")
    expect(page.locator(".rests")).to_contain_text("identified in 43 postures")


def test_tables_are_verified_and_calibrate_a_robot_that_is_used_at_once(look: Open) -> None:
    page = look("#calibrate")
    expect(page.locator("#number").first).to_have_text("no table yet")
    readings = page.get_by_label("open a file for data").and_(page.locator("input"))
    readings.first.set_input_files(EXAMPLES / "pendant.csv")
    expect(page.locator("#number").first).to_have_text("verified")
    settled(page)
    readings.last.set_input_files(EXAMPLES / "tracker.csv")
    expect(page.get_by_role("region", name="what each level leaves").locator("tbody tr")).to_have_count(5)
    expect(page.get_by_alt_text("every row's error")).to_be_visible()
    settled(page)
    page.get_by_role("button", name="use this robot in the other views").click()
    expect(page.locator("nav a[aria-current]")).to_contain_text("Place")
    expect(page.get_by_role("combobox", name="robot", exact=True)).to_have_value("calibrated.toml")
