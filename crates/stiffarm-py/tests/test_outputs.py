"""What an answer is written to is what the program writes, and what cannot be written is said before anything is computed."""

import re
import subprocess
from pathlib import Path

import pytest
import stiffarm
from conftest import path_of_program

EXAMPLES = Path(__file__).resolve().parents[3] / "docs/examples"
KUKA = "KR 210 R2700 extra"
TABLE, FANUC = str(EXAMPLES / "fanuc_r2000ic.csv"), str(EXAMPLES / "fanuc_r2000ic.toml")
ASKED = {
    "place": (
        lambda files: stiffarm.place(KUKA, task="circle:0.2", tolerance_mm=1, output=files),
        ["place", KUKA, "--task", "circle:0.2", "--tolerance-mm", "1"],
        ["a.html", "a.view.html", "a.svg", "shop.svg", "a.json"],
    ),
    "rank": (
        lambda files: stiffarm.rank(["BT200L", KUKA], tasks="A:0.3", output=files),
        ["rank", "--robots", f"BT200L,{KUKA}", "--task", "A:0.3"],
        ["a.html", "a.svg", "a.json"],
    ),
    "map": (lambda files: stiffarm.map(KUKA, size=40, output=files), ["map", KUKA, "--size", "40"], ["a.html", "a.svg", "a.json"]),
    "compare": (
        lambda files: stiffarm.compare("BT200L", KUKA, task="A:0.3", output=files),
        ["compare", "BT200L", KUKA, "--task", "A:0.3"],
        ["a.svg", "a.json"],
    ),
    "identify": (
        lambda files: stiffarm.identify(TABLE, robot=FANUC, date="2026-05-31", output=files),
        ["identify", TABLE, "--robot", FANUC, "--date", "2026-05-31"],
        ["a.html", "a.toml", "a.svg"],
    ),
    "calibrate": (
        lambda files: stiffarm.calibrate(KUKA, EXAMPLES / "tracker.csv", date="2026-05-31", output=files),
        ["calibrate", KUKA, str(EXAMPLES / "tracker.csv"), "--date", "2026-05-31"],
        ["a.html", "a.toml", "a.svg", "a.json"],
    ),
    "verify": (
        lambda files: stiffarm.verify(KUKA, EXAMPLES / "pendant.csv", date="2026-05-31", output=files),
        ["robots", "verify", KUKA, str(EXAMPLES / "pendant.csv"), "--date", "2026-05-31"],
        ["a.toml", "a.json"],
    ),
    "mill": (
        lambda files: stiffarm.mill("line:0.1", KUKA, feed_mm_per_min=600, force_n=(300, 100, 50), at=(1.7, 0, 0.8, 20), output=files),
        ["mill", "line:0.1", "--robot", KUKA, "--feed-mm-per-min", "600", "--force-n", "300,100,50", "--at", "1.7,0,0.8,20"],
        ["a.html", "a.view.html", "a.svg", "shop.svg", "a.src", "a.json"],
    ),
}


def plain(file: Path) -> str:
    """Without the day on which a report was made, and the order of options in its command."""
    text = re.sub(r"<pre>.*?</pre>", "", file.read_text("utf-8"), flags=re.DOTALL)
    return re.sub(r"\b20\d\d-\d\d-\d\d\b", "DAY", text)


@pytest.mark.filterwarnings("ignore:no load point is given")
@pytest.mark.parametrize("verb", ASKED)
def test_files_are_those_of_the_program(verb, tmp_path):
    ask, words, names = ASKED[verb]
    mine, theirs = tmp_path / "mine", tmp_path / "theirs"
    mine.mkdir()
    theirs.mkdir()
    ask([mine / name for name in names])
    outputs = [part for name in names for part in ("-o", str(theirs / name))]
    subprocess.run([path_of_program(), *words, *outputs, "--quiet"], check=True, capture_output=True)
    assert sorted(path.name for path in mine.iterdir()) == sorted(names)
    for name in names:
        assert plain(mine / name) == plain(theirs / name), name


def test_what_cannot_be_written_is_said_and_nothing_is_left(tmp_path):
    for output, says in [
        (tmp_path / "a.png", "stiffarm.plot draws"),
        (tmp_path / "a.csv", "to_pandas"),
        (tmp_path / "a.src", "expected a name that ends in"),
        (tmp_path / "none" / "a.svg", "there is no folder"),
        (tmp_path, "it is a folder"),
        ([tmp_path / "a.svg", tmp_path / "." / "a.svg"], "twice"),
        (3, "expected a path"),
    ]:
        with pytest.raises(stiffarm.StiffarmError, match=says):
            stiffarm.place("BT200L", task="A:0.3", output=output)
    process = tmp_path / "process.json"
    process.write_text((EXAMPLES / "endmill.toml").read_text())
    with pytest.raises(stiffarm.StiffarmError, match="reads this file"):
        stiffarm.force(process, output=process)
    assert "diameter" in process.read_text()
    with pytest.raises(stiffarm.StiffarmError, match="one posture"):
        stiffarm.compliance("BT200L", joints_deg=[[0] * 6] * 2, output=tmp_path / "a.json")
    assert [path.name for path in tmp_path.iterdir()] == ["process.json"]


def test_the_papers_folder_is_that_of_the_program(tmp_path):
    seen = []
    index = stiffarm.paper(tmp_path / "mine", progress=lambda done, total: seen.append((done, total)))
    subprocess.run([path_of_program(), "paper", "-o", str(tmp_path / "theirs"), "--quiet"], check=True, capture_output=True)
    names = sorted(path.name for path in (tmp_path / "theirs").iterdir())
    assert index == tmp_path / "mine" / "index.md" and sorted(path.name for path in index.parent.iterdir()) == names
    for name in names:
        assert (index.parent / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes(), name
    assert seen[-1] == (len(seen), len(seen))
    (tmp_path / "file").write_text("")
    with pytest.raises(stiffarm.StiffarmError, match="cannot make"):
        stiffarm.paper(tmp_path / "file")


def test_two_robots_of_one_name_are_two(tmp_path):
    usual = stiffarm.Robot("BT200L")
    softer = usual.with_compliance(drive_urad_per_nm=2)
    found = stiffarm.compare(usual, softer, task="A:0.3")
    assert found.ratio == pytest.approx(2, rel=1e-9) and found.a["robot"] == found.b["robot"] == "BT200L"
    # A name beside a robot of that name is the catalogue's.
    assert stiffarm.compare(softer, "BT200L", task="A:0.3").ratio == pytest.approx(0.5, rel=1e-9)
    ranked = stiffarm.rank([softer, usual], tasks="A:0.3")
    assert [row["robot"] for row in ranked.rows] == ["BT200L"] * 2
    values = [row["cells"][0]["deflection_mm"] for row in ranked.rows]
    assert values[1] == pytest.approx(2 * values[0], rel=1e-9)


def test_a_robot_may_have_any_name():
    for name in ("a, b", " c ", "paper", "all", "IRB*"):
        text = stiffarm.Robot("BT200L").to_toml().replace('name = "BT200L"', f'name = "{name}"')
        odd = stiffarm.Robot.from_toml(text)
        (row,) = stiffarm.rank([odd], tasks="A:0.3").rows
        assert row["robot"] == odd.name and stiffarm.place(odd, task="A:0.3").robot == odd.name


@pytest.mark.filterwarnings("ignore:joint 2 is beyond")
def test_what_is_odd_about_a_posture_is_said():
    with pytest.warns(UserWarning, match="if these are radians"):
        stiffarm.compliance(KUKA, joints_deg=(0, -1.5, 1.5, 0, 1, 0))  # beyond its limits, too
    with pytest.warns(UserWarning, match="beyond its limits"):
        stiffarm.compliance(KUKA, joints_deg=(0, -90, 90, 0, 300, 0))
    with pytest.warns(UserWarning, match="no joint angle is beyond 6.3 deg"):
        stiffarm.compliance(KUKA, joints_deg=[(0, -1.5, 1.5, 0, 1, 0)] * 3)
    with pytest.warns(UserWarning, match="joint 5 is beyond its limits at 2 of 3 postures"):
        stiffarm.compliance(KUKA, joints_deg=[(0, -90, 90, 0, 300, 0)] * 2 + [(0, -90, 90, 0, 30, 0)])


def test_a_report_says_what_no_file_holds(tmp_path):
    usual = stiffarm.Robot("BT200L")
    softer = usual.with_compliance(drive_urad_per_nm=2)
    for robot, is_named in [(usual, False), (softer, True)]:
        stiffarm.place(robot, task="A:0.3", output=tmp_path / "a.html")
        assert ("handed over by a program: BT200L" in (tmp_path / "a.html").read_text("utf-8")) == is_named
