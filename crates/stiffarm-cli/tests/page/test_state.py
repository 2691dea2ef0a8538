"""One question in the address and in a job file; commands to copy."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import expect

from conftest import Open, settled, until


def test_an_address_that_is_shared_shows_the_same(look: Open) -> None:
    page = look("#place?robot=BT200L&task=rect:0.5x0.3")
    page.get_by_label("tolerance [mm]").fill("2.5")
    page.wait_for_url("**tolerance-mm=2.5*")
    page.get_by_label("force [N]").fill("800")
    page.wait_for_url("**force-n=800*")
    settled(page)
    other = look(page.url[page.url.index("#") :])
    assert other.locator("#number").inner_text() == page.locator("#number").inner_text()
    assert other.locator(".live").inner_text() == page.locator(".live").inner_text()
    expect(other.get_by_label("force [N]")).to_have_value("800")


def test_the_question_stays_when_the_view_changes(look: Open) -> None:
    page = look("#place?robot=BT200L")
    page.get_by_role("link", name="Mill").click()
    settled(page)
    expect(page.get_by_role("combobox", name="robot", exact=True)).to_have_value("BT200L")
    page.go_back()
    expect(page.locator("nav a[aria-current]")).to_contain_text("Place")


def test_a_job_file_makes_the_round(look: Open, tmp_path: Path) -> None:
    page = look("#place?robot=BT200L&task=A:0.3&tolerance-mm=2&at=1.6,0.5")
    said = page.locator(".live").inner_text()
    with page.expect_download() as saved:
        page.get_by_role("button", name="save job").click()
    file = tmp_path / "place.toml"
    saved.value.save_as(file)
    assert 'verb = "place"' in file.read_text()
    other = look("#robots")
    other.get_by_label("open a job file").and_(other.locator("input")).set_input_files(file)
    expect(other.locator("nav a[aria-current]")).to_contain_text("Place")
    until(other, "document.querySelector('.live dl') !== null")
    settled(other)
    assert other.locator(".live").inner_text() == said


def test_figures_and_tables_are_downloaded_and_commands_copied(look: Open) -> None:
    page = look("#place?task=A:0.3")
    for label, begins in [("SVG", b"<svg"), ("PNG", b"\x89PNG"), ("PDF", b"%PDF"), ("JSON", b"{")]:
        with page.expect_download() as saved:
            page.get_by_role("button", name=f"download {label}", exact=True).click()
        assert Path(saved.value.path()).read_bytes().startswith(begins)
    page.get_by_role("button", name="as command, as Python").click()
    expect(page.locator(".code")).to_contain_text("stiffarm place")
    expect(page.locator(".code")).to_contain_text("stiffarm.place(")
    page.get_by_role("button", name="copy as command").click()
    expect(page.get_by_role("status").filter(has_text="as command is copied")).to_have_count(1)
    assert page.evaluate("navigator.clipboard.readText()").startswith("stiffarm place")


TWO_LINKS = 'name = "two links"\nvendor = "nobody"\narchitecture = "serial"\nstatus = "derived"\n[planar]\nl2_mm = 1000\nl3_mm = 800\n'


def test_a_link_holds_the_files_and_a_reload_keeps_them(look: Open, tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(TWO_LINKS)
    page = look("#place?task=circle:0.2")
    page.get_by_label("open a robot file for robot").and_(page.locator("input")).first.set_input_files(file)
    until(page, "location.hash.includes('mine.toml')")
    settled(page)
    said = page.locator(".live").inner_text()
    assert "mm" in said
    page.reload()
    settled(page)
    assert page.locator(".live").inner_text() == said
    page.get_by_role("button", name="copy link").click()
    expect(page.locator("#shared")).to_have_text("copied: it holds the whole question")
    link = page.evaluate("navigator.clipboard.readText()")
    # In a window of its own, which has opened nothing.
    other = look(link[link.index("#") :])
    assert other.locator(".live").inner_text() == said
    assert "files=" not in other.url


def test_back_leads_to_the_question_before(look: Open) -> None:
    page = look("#place?robot=BT200L&task=A:0.3")
    page.get_by_label("force [N]").fill("800")
    page.wait_for_url("**force-n=800*")
    page.get_by_label("tolerance [mm]").fill("2")
    page.wait_for_url("**tolerance-mm=2*")
    settled(page)
    page.go_back()
    page.wait_for_url("**force-n=800*")
    expect(page.get_by_label("tolerance [mm]")).to_have_value("")
    page.go_back()
    until(page, "!location.hash.includes('force-n')")
    expect(page.locator("nav a[aria-current]")).to_contain_text("Place")


def test_what_is_refused_dims_the_answer_before_and_a_comma_is_a_point(look: Open) -> None:
    page = look("#place?robot=BT200L&task=A:0.3", refused=True)
    page.get_by_label("force [N]").fill("80x")
    page.locator("body[data-stale]").wait_for(state="attached")
    assert float(page.locator("#decide > *").first.evaluate("element => getComputedStyle(element).opacity")) < 0.5
    page.get_by_label("force [N]").fill("812,5")
    page.wait_for_url("**force-n=812.5*")
    settled(page)
    page.locator("body:not([data-stale])").wait_for(state="attached")


def test_what_is_called_off_dims_the_answer_before(look: Open) -> None:
    page = look("#place?task=A:0.3")
    page.route("**/api/place?*", lambda route: None)
    page.get_by_label("force [N]").fill("900")
    page.get_by_role("button", name="cancel the work").click()
    expect(page.locator("body")).to_have_attribute("data-stale", "")
    expect(page.locator("body")).not_to_have_attribute("aria-busy", "true")


def test_a_comma_that_may_mean_a_thousand_is_refused(look: Open) -> None:
    page = look("#place?task=A:0.3", refused=True)
    page.get_by_label("force [N]").fill("1,000")
    expect(page.locator("[data-option=force-n] .fault")).to_contain_text("1,0")
    expect(page.locator("body")).to_have_attribute("data-stale", "")
    page.get_by_label("force [N]").fill("1e400")
    expect(page.locator("[data-option=force-n] .fault")).to_contain_text("1e400")


def test_a_job_that_has_no_view_is_refused(look: Open, tmp_path: Path) -> None:
    file = tmp_path / "compare.toml"
    file.write_text('verb = "compare"\na = "BT200L"\nb = "R-2000iC/210R"\ntask = "rect:0.5x0.5"\n')
    page = look("#robots")
    page.get_by_label("open a job file").and_(page.locator("input")).set_input_files(file)
    expect(page.locator("#fault")).to_contain_text("a job of compare has no view here")
    expect(page.locator("nav a[aria-current]")).to_contain_text("Robots")


def test_what_a_model_does_not_ask_is_named(look: Open) -> None:
    page = look("#place?keep-out=0.3..2,-1..1,..0.2")
    expect(page.locator(".unasked")).to_contain_text("keep out")
    page.get_by_label("model").select_option("spatial")
    expect(page.locator(".unasked")).to_have_count(0)
