"""Python says what the program says, key by key and bit by bit."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import stiffarm

ROBOTS = ["KR 210 R2700 extra", "IRB 6400 2.4-200", "Kawasaki BT200L", "KR 16-2", "M-900iA/200P"]


def test_defaults_are_those_of_the_program(program):
    assert stiffarm.rank().to_dict() == program("rank")
    assert stiffarm.study().to_dict() == program("study")
    assert stiffarm.map("BT200L").to_dict() == program("map", "BT200L")
    assert stiffarm.place("BT200L", task="B:0.5").to_dict() == program("place", "BT200L", "--task", "B:0.5")
    assert [robot.to_dict() for robot in stiffarm.robots()] == program("robots", "list")
    spatial = program("place", "BT200L", "--task", "B:0.5", "--model", "spatial")
    assert stiffarm.place("BT200L", task="B:0.5", model="spatial").to_dict() == spatial


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("task", ["A:0.3", "rect:0.2x0.7", "C:0.4"])
def test_placements(program, robot, task):
    of_sides = [
        (["--force-n", repr(1000 / 3), "--angle", repr(100 / 7)], {"force_n": 1000 / 3, "angle": 100 / 7}),
        (["--angle", "30", "--gap", "0.001"], {"angle": 30, "gap": 0.001}),
        (["--angle", "horizontal"], {"angle": "horizontal"}),
    ]
    for words, options in [
        ([], {}),
        (["--force-n", "123.4", "--tolerance-mm", "1.5"], {"force_n": 123.4, "tolerance_mm": 1.5}),
        (["--force-n", repr(1000 / 3)], {"force_n": 1000 / 3}),
        (["--within", "0.3..,0.1..2"], {"within_m": ((0.3, None), (0.1, 2))}),
        (["--gap", "0.001"], {"gap": 0.001}),
        *([] if task.startswith("A:") else of_sides),
    ]:
        assert stiffarm.place(robot, task=task, **options).to_dict() == program("place", robot, "--task", task, *words)


@pytest.mark.parametrize("robot", ROBOTS[:2])
def test_placements_in_space(program, robot):
    for words, options in [
        (["--tool-mm", "0,0,200"], {"tool_mm": (0, 0, 200)}),
        (
            ["--tool-mm", "10,-20,150,0,30,0", "--roll-deg", "45", "--tool-direction", "down"],
            {"tool_mm": np.array([10, -20, 150, 0, 30, 0]), "roll_deg": 45, "tool_direction": "down"},
        ),
        (
            ["--tool-direction=0", "--yaw-deg", "any", "--angle", "vertical", "--tolerance-mm", "3"],
            {"tool_direction": 0.0, "yaw_deg": "any", "angle": "vertical", "tolerance_mm": 3},
        ),
    ]:
        expected = program("place", robot, "--task", "rect:0.3x0.5", "--model", "spatial", *words)
        found = stiffarm.place(robot, task="rect:0.3x0.5", model="spatial", **options)
        assert found.to_dict() == expected


def test_rankings(program):
    names = ["KR 210*", "BT200L"]
    words = ["--robots", ",".join(names), "--task", "A:0.2,B:0.3", "--tolerance-mm", "2", "--within", "0..,0.."]
    found = stiffarm.rank(names, tasks=["A:0.2", "B:0.3"], tolerance_mm=2, within_m="0..,0..")
    assert found.to_dict() == program("rank", *words)
    found = stiffarm.rank("KR 210 R2700 extra, BT200L", tasks="B:0.3", model="spatial", tool_mm=(0, 0, 150))
    words = ["--robots", "KR 210 R2700 extra,BT200L", "--task", "B:0.3", "--model", "spatial", "--tool-mm", "0,0,150"]
    assert found.to_dict() == program("rank", *words)


def test_comparisons(program, tmp_path):
    words = ["KR 210 R2700 extra", "BT200L", "--task", "B:0.3", "--tolerance-mm", "2"]
    found = stiffarm.compare(stiffarm.Robot("KR 210 R2700 extra"), "BT200L", task="B:0.3", tolerance_mm=2)
    assert found.to_dict() == program("compare", *words)
    alone = stiffarm.place("BT200L", task="B:0.3", tolerance_mm=2).to_dict()
    assert found.b == {key: alone[key] for key in alone if key != "schema"} and found.better == "a"
    for name, length in (("short", 150), ("long", 300)):
        tool = f"verb = 'place'\nrobot = 'BT200L'\ntool-mm = [0, 0, {length}]\n"
        (tmp_path / f"{name}.toml").write_text(tool)
    setups = [tmp_path / "short.toml", tmp_path / "long.toml"]
    found = stiffarm.compare(*setups, task="A:0.2", model="spatial")
    assert found.to_dict() == program("compare", *map(str, setups), "--task", "A:0.2", "--model", "spatial")
    assert found.differ_in == ["tool"] and len(found.to_pandas()) == 2


def test_maps(program):
    for words, options in [
        (["--size", "60", "--zone", "B:0.5"], {"size": 60, "zone": "B:0.5"}),
        (["--step-m", "0.1", "--elbow", "down"], {"step_m": 0.1, "elbow": "down"}),
        (
            ["--size", "41", "--direction-deg", "30", "--component", "along"],
            {"size": 41, "direction_deg": 30, "component": "along"},
        ),
        (
            ["--size", "20", "--model", "spatial", "--force-n=300,100,-50", "--force-cone-deg", "10", "--component", "normal"],
            {"size": 20, "model": "spatial", "force_n": (300, 100, -50), "force_cone_deg": 10, "component": "normal"},
        ),
        (
            ["--size", "30", "--model", "spatial", "--tool-direction", "forward", "--roll-deg", "10"],
            {"size": 30, "model": "spatial", "tool_direction": "forward", "roll_deg": 10},
        ),
    ]:
        found = stiffarm.map(ROBOTS[0], **options)
        assert found.to_dict() == program("map", ROBOTS[0], *words)
        assert found.values_mm.shape == (len(found.z_m), len(found.x_m))
        assert np.isnan(found.values_mm).any()


@pytest.mark.filterwarnings("ignore:.*beyond its limits")
def test_postures(program):
    joints, tool, force = (10, -80, 85, 20, -30, 5), (0, 50, 200, 0, 10, 0), (100, -50, 20)
    for robot in ROBOTS:
        for words, options in [
            ([], {}),
            (["--tool-mm", "0,50,200,0,10,0"], {"tool_mm": tool}),
            (["--tool-mm", "0,50,200,0,10,0", "--force-n=100,-50,20"], {"tool_mm": tool, "force_n": force}),
            (["--force-n", "400"], {"force_n": 400}),
            (
                ["--force-n=100,-50,20", "--force-axes", "tool", "--feed-deg", "30", "--component", "along"],
                {"force_n": force, "force_axes": "tool", "feed_deg": 30, "component": "along"},
            ),
        ]:
            found = stiffarm.compliance(robot, joints_deg=joints, **options)
            assert found.to_dict() == program("compliance", robot, "--joints-deg=10,-80,85,20,-30,5", *words)


def test_studies(program):
    marked = stiffarm.study(task="rect:0.6x0.4", robot=stiffarm.Robot("BT200L"))
    assert marked.to_dict() == program("study", "--task", "rect:0.6x0.4", "--robot", "BT200L") and marked.mark is not None
    words = ["--tasks", "A,rect:1x3", "--sizes", "0.2,0.4", "--ratios", "0.9", "--range", "0.6..1.4", "--k3", "1,0.5"]
    found = stiffarm.study(tasks=["A", "rect:1x3"], sizes=[0.2, 0.4], ratios=[0.9], range=(0.6, 1.4), k3=(1, 0.5))
    assert found.to_dict() == program("study", *words)


def test_identification(program):
    examples = Path(__file__).parents[3] / "docs/examples"
    data, robot = examples / "fanuc_r2000ic.csv", examples / "fanuc_r2000ic.toml"
    expected = program("identify", str(data), "--robot", str(robot), "--load-mm", "6.9,245.3,319.3", "--fit", "huber")
    found = stiffarm.identify(data, robot=robot, load_mm=(6.9, 245.3, 319.3), fit="huber")
    assert found.to_dict() == expected
    assert found.correlation.shape == (6, 6) and found.outliers == [17, 11]
    assert found.identified_robot.drive_urad_per_nm[5] == pytest.approx(found.drives[5]["used_urad_per_nm"], rel=1e-9)
    pandas = pytest.importorskip("pandas")
    frame = pandas.read_csv(data, comment="#")
    assert stiffarm.identify(frame, robot=robot, load_mm="6.9,245.3,319.3", fit="huber").to_dict() == expected
    with pytest.raises(stiffarm.StiffarmError, match="row 3, fy_n"):
        stiffarm.identify(frame.assign(fy_n=[1, 2, np.nan, *frame.fy_n[3:]]), robot=robot)


def test_calibration(program):
    robot, data = "KR 210 R2700 extra", Path(__file__).parents[3] / "docs/examples/tracker.csv"
    expected = program("calibrate", robot, str(data), "--at", "1.8,0,0.8", "--level", "weight")
    found = stiffarm.calibrate(robot, data, at=(1.8, 0, 0.8), level="weight")
    assert isinstance(found, stiffarm.Calibration) and found.to_dict() == expected
    assert found.frames_mm_mrad.shape == (6, 6) and "[calibration]" in found.calibrated_robot.to_toml()
    pandas = pytest.importorskip("pandas")
    frame = pandas.read_csv(data, comment="#").rename(columns={"joint_1_deg": "A1", "x1_mm": "X"})
    found = stiffarm.calibrate(robot, frame, at=(1.8, 0, 0.8), level="weight", columns={"joint_1_deg": "A1", "x1_mm": "X"})
    assert found.to_dict() == expected
    with pytest.raises(stiffarm.StiffarmError, match="a controller computes"):
        stiffarm.calibrate(robot, data.with_name("pendant.csv"))


def test_verification(program):
    robot, data = "KR 210 R2700 extra", Path(__file__).parents[3] / "docs/examples/pendant.csv"
    known = {"base_mm": (0, 0, 0), "tool_mm": (0, 0, 0)}
    found = stiffarm.verify(robot, data, **known)
    assert found.verified and found.to_dict() == program("robots", "verify", robot, str(data), "--base-mm", "0,0,0", "--tool-mm", "0,0,0")
    assert "[verified]" in found.verified_robot.to_toml()
    any_of = stiffarm.verify(None, data, any=True)
    assert isinstance(any_of, stiffarm.FittingRobots) and any_of.to_dict() == program("robots", "verify", str(data), "--any")
    assert {fit["robot"] for fit in any_of.fits[:2]} == {"KR 210 R2700 extra", "KR 270 R2700"}
    other = stiffarm.verify("IRB 6700-200/2.6", data)
    assert not other.verified
    with pytest.raises(stiffarm.StiffarmError, match="no way of counting"):
        _ = other.verified_robot
    with pytest.raises(stiffarm.StiffarmError, match="robot is missing"):
        stiffarm.verify(None, data)


def test_modes(program):
    words = ("--joints-deg", "0,-90,90,0,45,0", "--tool-mass-kg", "60", "--tool-com-mm", "0,0,200", "--stiffness", "prior")
    found = stiffarm.modes("KR 210 R2700-2", joints_deg=(0, -90, 90, 0, 45, 0), tool_mass_kg=60, tool_com_mm=(0, 0, 200), stiffness="prior")
    assert found.to_dict() == program("modes", "KR 210 R2700-2", *words) and 1 < len(found) <= 6
    with pytest.raises(stiffarm.StiffarmError, match="mass"):
        stiffarm.modes("BT200L", joints_deg=[0] * 6)


def test_modes_over_a_zone(program):
    words = ["--task", "circle:0.2", "--at", "1.5,1.0", "--roll-deg", "0", "--tool-mass-kg", "60", "--tool-com-mm", "0,0,200"]
    found = stiffarm.modes("KR 210 R2700-2", task="circle:0.2", at=(1.5, 1.0), roll_deg=0, tool_mass_kg=60, tool_com_mm=(0, 0, 200))
    assert isinstance(found, stiffarm.ModesOverZone) and found.to_dict() == program("modes", "KR 210 R2700-2", *words)
    assert found.first_at_least_hz is not None and found.first_at_least_hz <= found.modes[0]["least_frequency_hz"]


def test_chatter(program):
    process, joints = Path(__file__).parents[3] / "docs/examples/endmill.toml", "0,-90,90,0,90,0"
    words = ("--robot", "KR 210 R2700-2", "--joints-deg", joints, "--feed", "1,0.5,0", "--tool-mass-kg", "60", "--tool-com-mm", "0,0,200", "--method", "mean")
    found = stiffarm.chatter(process, "KR 210 R2700-2", joints_deg=[float(part) for part in joints.split(",")], feed=(1, 0.5, 0), tool_mass_kg=60, tool_com_mm=(0, 0, 200), method="mean")
    assert found.to_dict() == program("chatter", str(process), *words) and len(found) == 191
    with pytest.raises(stiffarm.StiffarmError, match="mass"):
        stiffarm.chatter(process, "BT200L", joints_deg=[0] * 6, feed=(1, 0, 0))


def test_plans_of_measurements(program, tmp_path):
    words = ["--loads", "down,left", "--runs", "8", "--candidates", "400", "--load-mm", "0,50,200"]
    found = stiffarm.measure("KR 210 R2700 extra", loads=["down", "left"], runs=8, candidates=400, load_mm=(0, 50, 200))
    assert found.to_dict() == program("measure", "KR 210 R2700 extra", *words) and len(found) == 8
    pandas = pytest.importorskip("pandas")
    found.to_pandas().to_csv(tmp_path / "plan.csv", index=False)
    again = stiffarm.measure("KR 210 R2700 extra", loads="down,left", candidates=400, runs=8, load_mm=(0, 50, 200), compare=str(tmp_path / "plan.csv"))
    assert again.compared["value"] == pytest.approx(found.value, rel=1e-9)
    assert pandas.isna(found.to_pandas()["dx_mm"]).all()


def test_plans_of_postures_to_calibrate(program):
    words = ["--geometry", "--runs", "8", "--candidates", "60", "--marker-mm", "100,0,150", "--instrument", "3,-2,1.5"]
    found = stiffarm.measure("KR 210 R2700 extra", geometry=True, runs=8, candidates=60, marker_mm="100,0,150", instrument_m=(3, -2, 1.5))
    assert isinstance(found, stiffarm.CalibrationPlan) and len(found) == 8
    assert found.to_dict() == program("measure", "KR 210 R2700 extra", *words)
    with pytest.raises(stiffarm.StiffarmError, match="geometry"):
        stiffarm.measure("KR 210 R2700 extra", geometry=True, loads="down")


def test_catalogue_and_filters(program):
    found = stiffarm.robots("6700", vendor="abb", reach_m=(None, 2.8), payload_kg="200..")
    expected = program("robots", "list", "6700", "--vendor", "abb", "--reach-m", "..2.8", "--payload-kg", "200..")
    assert [robot.to_dict() for robot in found] == expected
    found = stiffarm.robots(architecture="quasi-serial", status=["estimated", "derived"])
    expected = program("robots", "list", "--architecture", "quasi-serial", "--status", "estimated,derived")
    assert [robot.to_dict() for robot in found] == expected


def test_robots_from_numbers_and_files(program, tmp_path):
    numbers = {
        "a1_mm": 350, "a2_mm": 41, "c1_mm": 675, "c2_mm": 1150, "c3_mm": 1200, "c4_mm": 215,
        "offset_deg": (0, -90, 0, 0, 0, 0), "sign": np.array([-1, 1, 1, -1, 1, -1]),
        "joint_deg": np.array([[-185, 185], [-140, -5], [-120, 155], [-350, 350], [-125, 125], [-350, 350]]),
        "drive_urad_per_nm": [0.7, 1.1, 1.9, 3, 5, 8],
    }  # fmt: skip
    planar = stiffarm.Robot.from_numbers("two links", l2_mm=1000, l3_mm=800, shoulder_deg=(0, 180), k3_urad_per_nm=2)
    for robot in (stiffarm.Robot.from_numbers("mine", vendor='A "B"', **numbers), planar):
        path = tmp_path / "robot.toml"
        path.write_text(robot.to_toml())
        assert stiffarm.Robot.from_toml(path) == stiffarm.Robot(path) == robot
        assert stiffarm.place(robot, task="A:0.3").to_dict() == program("place", str(path), "--task", "A:0.3")


def test_folders_of_robots(program, tmp_path):
    for name, length in (("b", 1000), ("a", 900)):
        robot = stiffarm.Robot.from_numbers(name, l2_mm=length, l3_mm=800)
        (tmp_path / f"{name}.toml").write_text(robot.to_toml())
    found = stiffarm.rank([tmp_path, "BT200L"], tasks="A:0.2")
    assert found.to_dict() == program("rank", "--robots", f"{tmp_path},BT200L", "--task", "A:0.2")


@pytest.mark.filterwarnings("ignore:.*beyond its limits")
def test_many_postures_are_what_single_ones_are():
    rng = np.random.default_rng(7)
    for robot in ROBOTS:
        joints = rng.uniform(-170, 170, (1203, 6))
        many = stiffarm.compliance(robot, joints_deg=joints, tool_mm=(30, 0, 200), full=True)
        for i in range(0, len(joints), 97):
            one = stiffarm.compliance(robot, joints_deg=joints[i], tool_mm=(30, 0, 200))
            worst = one.principal_um_per_n[2]
            # The bounds of the batch: eigenvalues that nearly agree, and some forty roundings.
            assert math.isclose(many.worst_um_per_n[i], worst, rel_tol=3e-8)
            assert np.allclose(many.compliance_um_per_n[i], one.compliance_um_per_n, rtol=0, atol=2e-14 * worst)


def test_scaled_joint_compliance_scales_the_deflection():
    robot = stiffarm.Robot("BT200L")
    softer = robot.with_compliance(drive_urad_per_nm=2)
    assert softer.drive_urad_per_nm == [2.0] * 6
    once, twice = stiffarm.cell(robot, "B:0.5"), stiffarm.cell(softer, "B:0.5")
    assert json.loads(json.dumps(twice)) == twice
    # Linear in the compliance; the search is cut off at a gap of 1e-4.
    assert math.isclose(twice["deflection_mm"], 2 * once["deflection_mm"], rel_tol=1e-4)
    assert robot != softer
    given = robot.with_compliance(drive_urad_per_nm=[1, 1, 1, 1, 1, 1])
    assert stiffarm.cell(given, "B:0.5")["deflection_mm"] == once["deflection_mm"]
