"""What makes no sense is refused in words, and what merely looks odd is taken."""

import numpy as np
import pytest
import stiffarm
from stiffarm import Robot, StiffarmError

ROBOT = Robot("KR 210 R2700 extra")
Q = np.array([[10.0, -80.0, 85.0, 20.0, -30.0, 5.0], [0.0, -90.0, 90.0, 0.0, 10.0, 0.0]])


def refused(match, call, *arguments, **options):
    with pytest.raises(StiffarmError, match=match):
        call(*arguments, **options)


@pytest.mark.parametrize("shape", [(), (5,), (7,), (2, 5), (6, 2), (1, 2, 6), (0,), (3, 0)])
def test_shapes(shape):
    refused("expected \\(6,\\) or \\(n, 6\\)", stiffarm.compliance, ROBOT, joints_deg=np.zeros(shape))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1080.1, 1e300])
def test_angles_that_are_none(bad):
    joints = np.tile(Q, (5000, 1))
    joints[7003, 4] = joints[9000, 2] = bad
    for full in (False, True):
        refused("posture 7003: joint 5", stiffarm.compliance, ROBOT, joints_deg=joints, full=full)
    refused("invalid value .* for 'joints_deg': expected", stiffarm.compliance, ROBOT, joints_deg=[0, 0, bad, 0, 0, 0])


def test_a_toolpath_is_no_zone():
    for path in ("part.nc", "line:0.1"):
        refused(f"task '{path}' is not understood", stiffarm.place, ROBOT, task=path)
        refused(f"task '{path}' is not understood", stiffarm.rank, [ROBOT], tasks=path)
        refused(f"task '{path}' is not understood", stiffarm.compare, ROBOT, "BT200L", task=path)


def test_types_that_hold_no_numbers():
    for bad in (Q.astype(complex), Q.astype(str), Q.astype(object), Q > 0, [[None] * 6], [[1] * 6, [2] * 5]):
        refused("joints_deg", stiffarm.compliance, ROBOT, joints_deg=bad)


def test_layouts_and_types_give_the_same_numbers():
    joints = np.round(np.tile(Q, (700, 1)))
    expected = stiffarm.compliance(ROBOT, joints_deg=joints).worst_um_per_n
    wide = np.zeros((1400, 12))
    wide[:, ::2] = joints
    read_only = joints.copy()
    read_only.flags.writeable = False
    unaligned = np.frombuffer(b"x" + joints.tobytes(), dtype=np.float64, offset=1).reshape(joints.shape)
    swapped = joints.astype(joints.dtype.newbyteorder())
    odd = [np.asfortranarray(joints), wide[:, ::2], read_only, unaligned, swapped, joints.tolist()]
    odd += [joints.astype(kind) for kind in (np.float32, np.int16, np.int64)] + [joints[::-1][::-1]]
    for given in odd:
        assert np.array_equal(stiffarm.compliance(ROBOT, joints_deg=given).worst_um_per_n, expected)
    assert np.array_equal(stiffarm.compliance(ROBOT, joints_deg=joints[::-1]).worst_um_per_n, expected[::-1])


def test_arrays_in_one_piece_are_not_copied():
    from stiffarm._given import numbers

    assert np.shares_memory(numbers("q", Q), Q)


def test_empty_arrays_give_empty_answers():
    found = stiffarm.compliance(ROBOT, joints_deg=np.zeros((0, 6)), full=True)
    assert found.worst_um_per_n.shape == (0,) and found.compliance_um_per_n.shape == (0, 3, 3)
    assert len(found.to_pandas()) == len(found.to_polars()) == 0


def test_huge_questions_are_refused_before_memory_is_taken():
    refused("cells", stiffarm.map, ROBOT, step_m=1e-6)
    refused("cells", stiffarm.map, ROBOT, size=100_000)


def test_numbers_out_of_range_are_named():
    place = {"task": "A:0.3"}
    for options in (
        {"force_n": 0}, {"force_n": np.nan}, {"force_n": np.inf}, {"tolerance_mm": -1}, {"gap": 0}, {"angle": 1e9},
        {"angle": "sideways"}, {"within_m": "1..0,.."}, {"within_m": ((np.nan, 1), None)}, {"within_m": ((1, 0), None)},
    ):  # fmt: skip
        name = next(iter(options))
        refused(f"{name}|range", stiffarm.place, ROBOT, **place, **options)
    for options in ({"tool_mm": (1, 2)}, {"tool_mm": (0, 0, 1e5)}, {"tool_direction": 91}, {"yaw_deg": np.nan}):
        refused(next(iter(options)), stiffarm.place, ROBOT, **place, model="spatial", **options)
    refused("gap", stiffarm.place, ROBOT, **place, model="spatial", gap=0.01)
    refused("tool_mm needs", stiffarm.place, ROBOT, **place, tool_mm=(0, 0, 100))
    refused("model", stiffarm.place, ROBOT, **place, model="flat")
    refused("size", stiffarm.map, ROBOT, size=1)
    refused("zone", stiffarm.map, ROBOT, within_m="0..")
    refused("space", stiffarm.map, ROBOT, model="spatial", zone="A:0.3")
    for no_zone in (5, ["A:0.3", "B:0.3"]):
        refused("zone=.*; expected a text", stiffarm.map, ROBOT, zone=no_zone)
        refused("task=.*; expected a text", stiffarm.measure, ROBOT, task=no_zone)
    refused("expected one flat zone", stiffarm.measure, ROBOT, task="box:0.3x0.2x0.1")
    refused("normal", stiffarm.map, ROBOT, component="normal")
    refused("expected", stiffarm.study, sizes=[-1])
    refused("two", stiffarm.study, compare=("serial",))
    refused("both ends", stiffarm.study, range=(0.5, np.inf))
    refused("k2 and k3 are both 0", stiffarm.study, k2=0, k3=0)
    refused("force_n", stiffarm.compliance, ROBOT, joints_deg=Q[0], force_n=(1, 2))
    refused("force_n", stiffarm.compliance, ROBOT, joints_deg=Q[0], force_n=(1, np.nan, 2))
    refused("one posture", stiffarm.compliance, ROBOT, joints_deg=Q, force_n=(1, 2, 3))


@pytest.mark.parametrize(
    ("options", "words", "typed", "raised"),
    [
        ({"gap": 0.01}, ["--gap", "0.01"], "--gap needs --zone", "gap needs zone"),
        ({"within_m": "0.."}, ["--within", "0.."], "--within needs --zone", "within_m needs zone"),
        (
            {"within_m": "0..", "model": "spatial"}, ["--within", "0..", "--model", "spatial"],
            "--within is of the planar model; it does not go with --model spatial, in space",
            'within_m is of the planar model; it does not go with model="spatial", in space',
        ),
        ({"size": 9, "step_m": 0.1}, ["--size", "9", "--step-m", "0.1"], "exclude each other", "exclude each other"),
        ({"force_cone_deg": 9}, ["--force-cone-deg", "9"], "a force of one number points in its worst direction", "a force of one number points in its worst direction"),
        (
            {"force_n": 0}, ["--force-n", "0"],
            "invalid value '0' for '--force-n <N>': expected a number from 0.001 to 1000000 N, or three along its axes, separated by commas",
            "invalid value '0' for 'force_n': expected a number from 0.001 to 1000000 N, or three along its axes, separated by commas",
        ),
    ],
)  # fmt: skip
def test_the_program_and_the_package_refuse_the_same(refusal, options, words, typed, raised):
    with pytest.raises(StiffarmError) as error:
        stiffarm.map(ROBOT, **options)
    assert raised in str(error.value)
    assert typed in refusal("map", ROBOT.name, *words)


#: Too large for a float, and for its digits to be printed.
LARGE, HUGE = 10**400, 10**5000
MASKED = np.ma.masked_array([0.0, 0.0, 200.0], [False, True, False])


def kind(value):
    return type(value).__name__


@pytest.mark.parametrize("bad", [LARGE, HUGE, object(), None, {1: 2}, [1, "x"], [[1], [2, 3]], np.ma.masked, MASKED, 1j], ids=kind)
def test_what_is_no_number_raises_the_error_of_the_package(bad):
    calls = [
        ("force_n", stiffarm.place, {"task": "A:0.3", "force_n": bad}), ("within_m", stiffarm.place, {"task": "A:0.3", "within_m": bad}),
        ("within_m", stiffarm.place, {"task": "A:0.3", "within_m": ((0, bad), None)}),
        ("tool_mm", stiffarm.place, {"task": "A:0.3", "model": "spatial", "tool_mm": bad}), ("step_m", stiffarm.map, {"step_m": bad}),
        ("size", stiffarm.map, {"size": bad}), ("joints_deg", stiffarm.compliance, {"joints_deg": bad}),
        ("joints_deg", stiffarm.compliance, {"joints_deg": [0, 0, 0, 0, 0, bad]}),
        ("force_n", stiffarm.compliance, {"joints_deg": Q[0], "force_n": bad}), ("drive_urad", ROBOT.with_compliance, {"drive_urad_per_nm": bad}),
    ]  # fmt: skip
    for name, call, options in calls:
        if bad is None and name in ("force_n", "within_m", "tool_mm", "step_m", "size"):
            continue
        refused(name, call, *(() if call == ROBOT.with_compliance else (ROBOT,)), **options)
    for name in ("sizes", "ratios", "range", "k2", "k3"):
        if bad is not None:
            refused(name, stiffarm.study, **{name: bad})
    for name in ("payload_kg", "reach_m"):
        if bad is not None:
            refused(name, stiffarm.robots, **{name: (0, bad)})
            refused("l2_mm", Robot.from_numbers, "x", l2_mm=bad, l3_mm=800)


@pytest.mark.parametrize("bad", [5, b"BT200L", [5], [None], object(), HUGE], ids=kind)
def test_what_is_no_text_raises_the_error_of_the_package(bad):
    for call in (Robot, Robot.from_toml, Robot.from_urdf, stiffarm.map, stiffarm.rank):
        if bad != b"BT200L" or call == stiffarm.rank:
            refused("expected", call, bad)
    for call, name in (
        (stiffarm.rank, "tasks"), (stiffarm.study, "tasks"), (stiffarm.study, "compare"), (stiffarm.robots, "words"),
        (stiffarm.robots, "vendor"), (stiffarm.robots, "status"), (stiffarm.robots, "architecture"), (stiffarm.robots, "among"),
    ):  # fmt: skip
        refused(f"{name}|robots", call, **{name: bad})
    refused("task", stiffarm.place, ROBOT, task=bad)
    refused("expected a text", Robot.catalogue, bad)
    refused("expected a text", Robot.from_urdf, "x.urdf", name=bad)
    refused("expected a text", Robot.from_numbers, bad, l2_mm=900, l3_mm=800)


@pytest.mark.parametrize("bad", [-1, 0, 1025, HUGE, 1.5, "two", [1]], ids=kind)
def test_threads_that_are_no_count(bad):
    refused("threads", stiffarm.set_threads, bad)


def test_whole_numbers_of_any_type_and_masks_without_a_mark_are_taken():
    expected = stiffarm.map(ROBOT, size=12)
    for kind in (np.int8, np.int64, np.uint16):
        assert stiffarm.map(ROBOT, size=kind(12)) == expected
        stiffarm.set_threads(kind(2))
    stiffarm.set_threads(None)
    refused("size=True", stiffarm.map, ROBOT, size=True)
    open_mask = np.ma.masked_array(Q, np.zeros(Q.shape, dtype=bool))
    assert stiffarm.compliance(ROBOT, joints_deg=open_mask) == stiffarm.compliance(ROBOT, joints_deg=Q)
    assert stiffarm.study(tasks="A", sizes=(size for size in (0.2, 0.3))) == stiffarm.study(tasks="A", sizes=[0.2, 0.3])


def test_a_cell_of_two_robots_of_one_name_is_not_guessed():
    same = [Robot.from_numbers("twin", l2_mm=length, l3_mm=800) for length in (900, 1000)]
    ranking = stiffarm.rank(same, tasks="A:0.3")
    assert len(ranking) == 2
    refused("2 robots are called twin", ranking.cell, "twin", "A:0.3")


def test_robots_that_are_none(tmp_path):
    refused("did you mean", Robot, "KR 210 R2700 extr")
    refused("cannot read", Robot, tmp_path / "nothing.toml")
    refused("a pipe, a device or a socket", Robot, "/dev/zero")
    refused("it is a folder", Robot, tmp_path)
    refused("ends in .toml", stiffarm.rank, str(tmp_path))
    (tmp_path / "wide.toml").write_text("name = 'a'", encoding="utf-16")
    refused("save it as UTF-8", Robot, tmp_path / "wide.toml")
    (tmp_path / "long.toml").write_bytes(b"#" * (5 << 20))
    refused("larger than 4 MiB", Robot.from_toml, tmp_path / "long.toml")
    refused("matches no robot", stiffarm.rank, "xyz*")
    refused("a1_mm: missing", Robot.from_numbers, "x", c2_mm=1000)
    refused("a9_mm", Robot.from_numbers, "x", a9_mm=1000)
    refused("nan|NaN", Robot.from_numbers, "x", l2_mm=np.nan, l3_mm=800)
    refused("if this is in m", Robot.from_numbers, "x", l2_mm=1.0, l3_mm=800)
    refused("drive_urad_per_nm", ROBOT.with_compliance, drive_urad_per_nm=[1, 2])
    refused("every drive is rigid", ROBOT.with_compliance, drive_urad_per_nm=0)
    refused("urad", ROBOT.with_compliance, drive_urad_per_nm=-1)
    refused("planar robot", stiffarm.compliance, Robot.from_numbers("x", l2_mm=900, l3_mm=800), joints_deg=Q)
    refused("none of", stiffarm.robots, vendor="nobody")
    refused("status", stiffarm.robots, status="known")
    assert issubclass(StiffarmError, ValueError)


def test_answers_say_what_they_have():
    found = stiffarm.place(ROBOT, task="A:0.3")
    assert found.feasible and found.reason is None and found.roll_deg is None
    with pytest.raises(AttributeError, match="deflection_mm"):
        found.deflection_m  # noqa: B018
    nowhere = stiffarm.place(ROBOT, task="A:9")
    assert not nowhere.feasible and nowhere.deflection_mm is None and "fit" in nowhere.reason
