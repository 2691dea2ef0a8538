"""Sweeps on a cluster: the same numbers and the same bytes, and who wins how often. Real processes throughout."""

import hashlib
import math
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pyarrow.parquet as pq
import pytest
import stiffarm
from stiffarm import Robot, StiffarmError, cluster
from stiffarm.cluster import _question
from sweeps import ASKED, ROBOTS, left_over, parts, refused


def test_every_row_is_what_place_says(done):
    frame = done.to_arrow().to_pylist()
    assert len(frame) == len(done) == 12 * 3 * 3 * 4
    robots = [Robot(name) for name in ROBOTS]
    cases = [(s, t, f, r) for s in range(12) for t in ASKED["tasks"] for f in ASKED["force_n"] for r in range(4)]
    for row, (s, task, force, r) in zip(frame, cases):
        made = robots[r].with_compliance(drive_urad_per_nm=robots[r].drive_urad_per_nm * ASKED["scenarios"][s, r])
        cell = stiffarm.cell(made, task, force_n=force)
        assert (row["scenario"], row["task"], row["force_n"], row["robot"]) == (s, task, force, ROBOTS[r])
        for key in ("feasible", "deflection_mm", "lower_bound_mm", "x_m", "z_m", "angle_deg", "elbow", "reason"):
            assert row[key] == cell.get(key)
        assert [row[f"compliance_factor_{drive}"] for drive in range(1, 7)] == ASKED["scenarios"][s, r].tolist()
        assert row["error"] is None and (row["deflection_mm"] is None) == (task == "A:9")


@pytest.mark.parametrize("model", ["planar", "spatial"])
def test_doubled_forces_give_the_bits_that_are_computed(model):
    options = {"model": model, "tolerance_mm": "1.5"}
    forces = [375.3 * 2**k for k in (0, 1, -2, 3)]
    robots = cluster._distinguished(ROBOTS if model == "planar" else ROBOTS[:1])
    asked = _question.Question(robots, ["B:0.5", "A:9"], ["B:0.5", "A:9"], forces, options, cluster.spread(1), 99)
    alone = [
        row
        for task in ("B:0.5", "A:9")
        for force in forces
        for row in _question.Question(robots, [task], [task], [force], options, asked.scenarios, 99).answer(0, len(robots))
    ]
    known = set(asked.schema().names)
    pick = [{key: row[key] for key in row if key in known} for row in asked.answer(0, asked.rows)]
    assert pick == [{key: row[key] for key in row if key in known} for row in alone]
    assert {row["pass"] for row in pick} == {True, False}


@pytest.mark.parametrize("options", [{}, {"angle": 90}])
def test_the_order_is_that_of_rank(client, tmp_path, options):
    tasks = ["A:0.3", "B:9", "B:0.5"]
    found = cluster.rank(tasks=tasks, client=client, folder=tmp_path / "r", **options)
    expected = stiffarm.rank(tasks=tasks, **options)
    assert [row["robot"] for row in found.rows] == [row["robot"] for row in expected.rows]
    for row, other in zip(found.rows, expected.rows):
        assert math.isclose(row["mean_ratio"], other["mean_ratio"], rel_tol=1e-14)
        for task in tasks:
            assert row[task] == expected.cell(row["robot"], task).deflection_mm
        assert (row["rank"] is None) == (row["status"] == "estimated")
        assert (row["rank"], row["rank_tied"]) == (other["rank"], other["rank_tied"])
    assert len(found.to_pandas()) == len(found) == 10 and "best KR 210 R2700 extra" in repr(found)


def test_space(client, tmp_path):
    options = {"model": "spatial", "tool_mm": (0, 0, 200), "roll_deg": 0}
    planar = Robot.from_numbers("two links", l2_mm=900, l3_mm=800)
    found = cluster.sweep([ROBOTS[0], planar], tasks="B:0.3", client=client, folder=tmp_path / "s", **options)
    row, flat = found.to_arrow().to_pylist()
    cell = stiffarm.cell(ROBOTS[0], "B:0.3", **options)
    assert {key: row[key] for key in row if key in cell} == {key: cell[key] for key in row if key in cell}
    assert row["singular_margin_deg"] is not None and "two links" in flat["error"] and flat["feasible"] is None


def test_columns_carry_units_and_types(done):
    schema = pq.read_schema(done.files[0])
    assert {str(schema.field(name).type) for name in schema.names if name.endswith(("_mm", "_m", "_deg", "_n"))} == {"double"}
    assert not schema.field("robot").nullable and schema.field("error").nullable
    frame, other = done.to_pandas(), done.to_polars()
    assert list(frame.columns) == other.columns == schema.names and frame.shape == other.shape
    assert other["deflection_mm"].null_count() == 12 * 3 * 4
    # The folder is an ordinary data set: what is no part begins with an underscore.
    assert pq.read_table(done.folder).equals(done.to_arrow())
    assert cluster.load(done.folder).wins() == done.wins()


def test_bytes_do_not_depend_on_the_workers(done, tmp_path):
    again = cluster.sweep(ROBOTS, folder=tmp_path / "one", workers=1, **ASKED)
    assert parts(again.folder) == parts(done.folder) and len(again.files) == 8
    assert not left_over(again.folder)


def test_finished_chunks_are_not_computed_again(done, client, tmp_path):
    folder = tmp_path / "copy"
    shutil.copytree(done.folder, folder)
    expected, names = parts(folder), sorted(parts(folder))
    (folder / names[2]).unlink()
    (folder / names[5]).write_bytes(expected[names[5]][:-9])
    before = {name: (folder / name).stat().st_mtime_ns for name in names if name != names[2]}
    with pytest.raises(StiffarmError, match="1 of 8 chunks are missing"):
        cluster.load(folder)
    with pytest.warns(RuntimeWarning, match=f"{names[5]} was changed"):
        cluster.sweep(ROBOTS, folder=folder, client=client, **ASKED)
    assert parts(folder) == expected
    changed = {name for name in before if (folder / name).stat().st_mtime_ns != before[name]}
    assert changed == {names[5]}


@pytest.mark.parametrize(
    "change",
    [{"robots": ROBOTS[::-1]}, {"tasks": "A:0.3"}, {"force_n": 7}, {"scenarios": None}, {"gap": 0.01}, {"chunk_rows": 9},
     {"scenarios": ASKED["scenarios"] * 1.0000001}],
)  # fmt: skip
def test_another_question_is_never_mixed_in(done, change):
    before = parts(done.folder)
    refused("answers another question .*differ", folder=done.folder, **change)
    assert parts(done.folder) == before


def test_another_version_is_never_mixed_in(done, client, monkeypatch, tmp_path):
    monkeypatch.setattr(stiffarm._stiffarm, "__version__", "9.9.9")
    refused("begun by stiffarm .* has stiffarm 9.9.9", folder=done.folder)
    refused("begun by stiffarm 9.9.9", folder=tmp_path / "new", client=client)
    assert cluster.load(done.folder).wins() == done.wins(), "what another version made can be read"


def test_two_builds_of_one_version_are_never_mixed(done, client, monkeypatch, tmp_path):
    monkeypatch.setattr(_question, "_sources", lambda: "ab" * 32)
    refused(r"begun by stiffarm .* has stiffarm .* \(sources abababababab\)", folder=done.folder)
    refused(r"begun by stiffarm .* \(sources abababababab\)", folder=tmp_path / "new", client=client)
    assert cluster.load(done.folder).wins() == done.wins()


def test_the_fingerprint_holds_every_source():
    """By hashlib alone, from the files of the repository."""
    crates = Path(__file__).resolve().parents[2]

    def sums(root, files):
        names = sorted(path.relative_to(root).as_posix() for path in files)
        return "".join(f"{hashlib.sha256((root / name).read_bytes()).hexdigest()}  {name}\n" for name in names).encode()

    rust = [path for name in ("stiffarm", "stiffarm-ask", "stiffarm-py") for path in (crates / name / "src").rglob("*") if path.is_file()]
    expected = hashlib.sha256(sums(crates, rust)).hexdigest()
    assert len(rust) > 50 and stiffarm._stiffarm.__sources__ == expected, "is the installed package that of these sources?"
    package = Path(stiffarm.__file__).parent
    assert _question._sources() == hashlib.sha256(expected.encode() + sums(package, package.rglob("*.py"))).hexdigest()


def test_wins_against_a_count_by_hand(done):
    """Shares and quantiles from the rows alone, without the code of wins()."""
    rows, wins = done.to_arrow().to_pylist(), done.wins()
    for task in ("A:0.3", "B:0.5"):
        values = {name: [] for name in ROBOTS}
        for row in rows:
            if (row["task"], row["force_n"]) == (task, 1000):
                values[row["robot"]].append(row["deflection_mm"])
        all_of_them = [min(ROBOTS, key=lambda name: values[name][s]) for s in range(12)]  # noqa: B023
        published = [min(ROBOTS[:3], key=lambda name: values[name][s]) for s in range(12)]  # noqa: B023
        for row in wins.rows:
            if (row["task"], row["force_n"]) == (task, 1000):
                assert row["share_with_estimated"] == all_of_them.count(row["robot"]) / 12
                assert row["share"] == (None if row["estimated"] else published.count(row["robot"]) / 12)
                assert row["median_mm"] == np.median(values[row["robot"]]) and row["scenarios"] == 12
                assert row["p05_mm"] <= row["median_mm"] <= row["p95_mm"] and row["feasible_share"] == 1
    nowhere = [row for row in wins.rows if row["task"] == "A:9"]
    assert all(not row["share_with_estimated"] and row["median_mm"] is None and row["feasible_share"] == 0 for row in nowhere)
    assert len(wins.to_pandas()) == len(wins) == len(wins.to_polars()) == 3 * 3 * 4


def test_an_estimated_robot_wins_nowhere_unmarked(done):
    wins = done.wins()
    assert any(row["estimated"] and row["share_with_estimated"] for row in wins.rows)
    assert all("6400 2.4-200~" in line for line in wins.summary if "6400" in line)
    assert not any("6400" in line for line in wins.summary if "is the stiffest" in line)
    ax = done.plot(task="B:0.5", force_n=1000)
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert "ABB IRB 6400 2.4-200~" in names and "KUKA KR 210 R2700 extra" in names and "[mm]" in ax.get_xlabel()
    plt.close(ax.figure)
    ax = done.plot(most=2)
    assert len(ax.get_yticks()) == 2 and "the first 2 of 4 robots" in ax.get_title(loc="left")
    plt.close(ax.figure)
    with pytest.raises(KeyError):
        done.plot(task="B:7")


def test_equal_robots_share_their_wins(client, tmp_path):
    twin = Robot.from_numbers("twin", l2_mm=1150, l3_mm=1000)
    other = Robot.from_numbers("other", l2_mm=1150, l3_mm=1000)
    found = cluster.sweep([twin, other], tasks="A:0.2", scenarios=cluster.spread(6), client=client, folder=tmp_path / "t")
    assert [row["share_with_estimated"] for row in found.wins().rows] == [0.5, 0.5]
    assert [row["share"] for row in found.wins().rows] == [None, None] and "no robot whose" in found.wins().summary[0]


def test_a_scenario_that_fails_for_one_robot_counts_for_none(client, tmp_path):
    scenarios = cluster.spread(6, robots=2)
    scenarios[:, 1] = 3.0
    scenarios[[1, 4], 0] = np.nan
    names = ["KR 210 R2700 extra", "IRB 6650S-200"]
    found = cluster.sweep(names, tasks="A:0.3", scenarios=scenarios, client=client, folder=tmp_path / "f").wins()
    counted = {row["robot"]: (row["scenarios"], row["errors"], row["share"]) for row in found.rows}
    assert counted == {names[0]: (4, 2, 1.0), names[1]: (4, 0, 0.0)}


@pytest.mark.filterwarnings("ignore:.*beyond its limits")
def test_a_number_of_scenarios_draws_the_drives_as_every_interval_does(client, tmp_path):
    """The interval of a posture comes from 2000 draws: with the factors that a sweep has, posture by posture, it is the same."""
    names, options = ["KR 210 R2700 extra", "IRB 6650S-200"], {"model": "spatial", "chunk_rows": 3}
    made = cluster.sweep(names, tasks="circle:0.1", scenarios=2, client=client, folder=tmp_path / "d", **options)
    question, rows = _question.read_question(made.folder), made.to_arrow().to_pylist()
    asked = {"joints_deg": [10.0, -70.0, 100.0, 20.0, 40.0, 0.0], "force_n": [300.0, -500.0, 800.0]}
    _, drawn = cluster._drawn(cluster._distinguished(names), {"model": "spatial"}, 2000)
    for r, name in enumerate(names):
        mine = [[row[f"compliance_factor_{drive}"] for drive in range(1, 7)] for row in rows if row["robot"] == name]
        assert np.array_equal(mine, drawn[:2, r])
        nominal = Robot.from_toml(question.robots[r]["toml"])
        posture = stiffarm.compliance(name, stiffness="prior", **asked).to_dict()
        assert nominal.drive_urad_per_nm == pytest.approx(posture["drive_urad_per_nm"], rel=1e-12)
        moved = []
        for factors in drawn[:, r]:
            arm = nominal.with_compliance(drive_urad_per_nm=nominal.drive_urad_per_nm * factors)
            moved.append(np.linalg.norm(stiffarm.compliance(arm, **asked).to_dict()["deflection_mm"]))
        fifth, last = np.sort(moved)[[100, 1899]]
        assert (fifth, last) == pytest.approx((posture["deflection_mm_p05"], posture["deflection_mm_p95"]), rel=1e-9)


def test_a_robot_of_which_nothing_is_known_has_no_draws(client, tmp_path):
    planar = Robot.from_numbers("planar", l2_mm=1150, l3_mm=1000)
    options = {"tasks": "A:0.3", "scenarios": 2, "client": client}
    with pytest.raises(StiffarmError, match="the drive stiffness of planar has no stated uncertainty"):
        cluster.sweep(planar, folder=tmp_path / "n", **options)
    with pytest.raises(StiffarmError, match="drive stiffness of KR 210 R2700 extra .* stiffness='prior'"):
        cluster.sweep(ROBOTS[0], folder=tmp_path / "o", **options)
    found = cluster.sweep([ROBOTS[0], planar], folder=tmp_path / "p", stiffness="prior", **options).to_arrow().to_pylist()
    assert [row["error"] is None for row in found] == [True, False] * 2 and "planar" in found[1]["error"]
    for wrong in (0, -1, True, 2.5):
        with pytest.raises(StiffarmError, match="scenarios"):
            cluster.sweep(ROBOTS[0], folder=tmp_path / "q", **{**options, "scenarios": wrong})


def test_who_holds_the_tolerance_how_often(client, tmp_path):
    """From the rows alone; the ends of the interval are the roots of (p - share)^2 = z^2 p (1 - p) / n."""
    asked = {"tasks": ["A:0.3", "A:9"], "force_n": [700, 1000], "scenarios": cluster.spread(40, robots=4, seed=7), "tolerance_mm": 1.2}
    found = cluster.sweep(ROBOTS, folder=tmp_path / "h", client=client, **asked)
    rows, wins = found.to_arrow().to_pylist(), found.wins()
    shares = set()
    for row in wins.rows:
        key = (row["task"], row["force_n"], row["robot"])
        mine = [one["deflection_mm"] for one in rows if (one["task"], one["force_n"], one["robot"]) == key]
        share = sum(value is not None and value <= 1.2 for value in mine) / 40
        assert row["held_share"] == share and row["scenarios"] == 40
        z2 = 1.959963984540054**2
        low, high = np.sort(np.roots([1 + z2 / 40, -2 * share - z2 / 40, share**2]).real)
        assert np.allclose((row["held_share_low"], row["held_share_high"]), (low, high), rtol=0, atol=1e-12)
        shares.add(share)
    assert 0.0 in shares and any(0 < share < 1 for share in shares)
    sentences = [line for line in wins.summary if "holds 1.2 mm in" in line]
    assert sentences and all("% of them (95 % confidence" in line for line in sentences)
    assert {"held_share", "held_share_low", "held_share_high"} <= set(wins.to_pandas().columns)
    assert cluster.load(found.folder).wins() == wins


def test_without_a_tolerance_nobody_holds_one(done):
    assert all(row["held_share"] is None and row["held_share_low"] is None for row in done.wins().rows)
    assert not any("holds" in line for line in done.wins().summary)


def test_the_interval_of_a_share_by_hand():
    """Half of four: (2 + 1.96^2 / 2 -+ 1.96 sqrt(2 * 2 / 4 + 1.96^2 / 4)) / (4 + 1.96^2), with 1.96 for 1.959964."""
    from stiffarm.cluster._answer import wilson

    z2 = 3.8416
    half = 1.96 * math.sqrt(1 + z2 / 4)
    assert np.allclose(wilson(2, 4), ((2 + z2 / 2 - half) / (4 + z2), (2 + z2 / 2 + half) / (4 + z2)), rtol=0, atol=1e-5)


def test_wilson_against_published_values():
    """Newcombe 1998, table I, method 3: 81 of 263, 15 of 148, 0 of 20, 1 of 29."""
    from stiffarm.cluster._answer import wilson

    for wins, of, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0, 0.1611), (1, 29, 0.0061, 0.1718)):
        assert np.allclose(wilson(wins, of), (low, high), rtol=0, atol=5.1e-5)
    assert wilson(0, 0) == (0, 1) and wilson(5, 5)[1] == 1


def test_spread_is_what_it_says():
    factors = cluster.spread(4000, percent=30, robots=2, seed=1)
    assert factors.shape == (4000, 2, 6) and np.array_equal(factors, cluster.spread(4000, robots=2, seed=1))
    stiffness = 1 / factors
    assert 0.7 <= stiffness.min() < 0.701 and 1.299 < stiffness.max() <= 1.3 and abs(stiffness.mean() - 1) < 0.005
    assert np.array_equal(cluster.spread(2, percent=0), np.ones((2, 6)))


def test_progress_on_a_terminal(tmp_path, client, capsys):
    options = {"tasks": "A:0.3", "client": client, "chunk_rows": 2}
    cluster.sweep(ROBOTS, folder=tmp_path / "a", **options)
    assert capsys.readouterr().err == ""
    cluster.sweep(ROBOTS, folder=tmp_path / "b", progress=True, **options)
    assert "2/2 chunks" in capsys.readouterr().err
