"""Answers and robots behave as Python's own values do."""

import copy
import importlib.metadata
import multiprocessing
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pandas
import pytest
import stiffarm
from stiffarm import Robot, StiffarmError

ROBOT = Robot("KR 210 R2700 extra")


def answers():
    joints = np.random.default_rng(3).uniform(-90, 90, (9, 6))
    return [
        stiffarm.compliance(ROBOT, joints_deg=joints[0], force_n=(1, 2, 3)),
        stiffarm.compliance(ROBOT, joints_deg=joints, full=True),
        stiffarm.place(ROBOT, task="A:0.3"),
        stiffarm.place(ROBOT, task="A:9"),
        stiffarm.rank([ROBOT, "BT200L"], tasks=["A:0.3", "A:9"]),
        stiffarm.map(ROBOT, size=30, zone="B:0.3"),
        stiffarm.map(ROBOT, size=12, model="spatial"),
        stiffarm.study(tasks="A", sizes=[0.2, 0.9]),
    ]


@pytest.mark.filterwarnings("ignore:joint .* beyond its limits", "ignore:the angle between")
def test_answers_can_be_pickled_copied_and_compared():
    first, again = answers(), answers()
    for i, (answer, same) in enumerate(zip(first, again)):
        assert answer == same == pickle.loads(pickle.dumps(answer)) == copy.deepcopy(answer)
        assert all(answer != other for j, other in enumerate(first) if i != j)
        assert type(answer).__name__ in repr(answer) and len(repr(answer)) < 300
        assert set(answer.to_dict()) <= set(dir(answer))
        answer.to_dict().clear()
        assert answer == same


def test_robots_can_be_pickled_compared_and_hashed():
    for robot in stiffarm.robots()[::7]:
        again = pickle.loads(pickle.dumps(robot))
        assert again == robot and hash(again) == hash(robot) and repr(again) == repr(robot)
    assert len({ROBOT, Robot("kuka kr210-r2700 extra"), Robot("BT200L")}) == 2
    assert ROBOT != "KR 210 R2700 extra"
    with pytest.raises(AttributeError):
        ROBOT.name = "other"
    assert len(stiffarm.rank([ROBOT, "KR 210 R2700 extra", ROBOT], tasks="A:0.2")) == 1
    error = pickle.loads(pickle.dumps(StiffarmError("words")))
    assert type(error) is StiffarmError and str(error) == "words"


@pytest.mark.filterwarnings("ignore:joint .* beyond its limits", "ignore:the angle between")
def test_tables_go_to_pandas_and_polars():
    for answer in answers()[1:]:
        frame, other = answer.to_pandas(), answer.to_polars()
        assert list(frame.columns) == other.columns and frame.shape == other.shape
    ranking = stiffarm.rank([ROBOT, "BT200L"], tasks=["A:0.3", "A:9"])
    frame = ranking.to_pandas()
    assert list(frame["rank"]) == [1, 1, 2, 2] and list(frame["feasible"]) == [True, False] * 2
    best = frame.iloc[0]
    assert best["deflection_mm"] == ranking.cell(best["robot"], best["task"]).deflection_mm
    assert frame["deflection_mm"].isna().sum() == 2
    assert ranking.to_polars()["deflection_mm"].null_count() == 2
    section = stiffarm.map(ROBOT, size=30)
    assert isinstance(section.to_pandas(), pandas.DataFrame) and len(section.to_pandas()) == section.values_mm.size
    assert section.to_polars()["deflection_mm"].null_count() == np.isnan(section.values_mm).sum()


@pytest.mark.filterwarnings("ignore:joint .* beyond its limits", "ignore:the angle between")
def test_the_interpreter_goes_on_while_a_long_call_runs():
    joints = np.random.default_rng(1).uniform(-90, 90, (400_000, 6))
    stiffarm.set_threads(1)
    try:
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.001)

        other = threading.Thread(target=tick)
        other.start()
        start = time.perf_counter()
        while time.perf_counter() - start < 0.3:
            begun = time.perf_counter()
            stiffarm.compliance(ROBOT, joints_deg=joints)
            ended = time.perf_counter()
        done.set()
        other.join()
    finally:
        stiffarm.set_threads(None)
    # Ticks strictly inside the last call: with the lock held there would be none but at its ends.
    inside = [moment for moment in ticks if begun + 0.2 * (ended - begun) < moment < ended - 0.2 * (ended - begun)]
    assert inside, (ended - begun, len(ticks))


def test_calls_from_several_threads_agree():
    found = {}

    def work(i):
        found[i] = stiffarm.rank(["BT200L", ROBOT], tasks=["A:0.3", "B:0.3"])

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(answer == found[0] for answer in found.values()) and len(found) == 4


#: One thread is asked for; three callers compute side by side, then the main thread.
ALONE = """
import os, threading, time
import numpy as np, stiffarm

stiffarm.set_threads(1)
joints = np.random.default_rng(1).uniform(-90, 90, (100_000, 6))
before, begun, taken = set(os.listdir("/proc/self/task")), time.process_time(), []

def work():
    start = time.thread_time()
    stiffarm.compliance("BT200L", joints_deg=joints)
    stiffarm.place("BT200L", task="A:0.2", model="spatial", roll_deg=0)
    taken.append(time.thread_time() - start)

threads = [threading.Thread(target=work) for _ in range(3)]
for thread in threads: thread.start()
for thread in threads: thread.join()
all_of_it = time.process_time() - begun
stiffarm.rank(["BT200L", "KR 210 R2700 extra"], tasks="A:0.3")
stiffarm.map("BT200L", size=40), stiffarm.map("BT200L", size=20, model="spatial"), stiffarm.study(tasks="A", sizes=[0.2])
assert set(os.listdir("/proc/self/task")) == before, "threads were made"
assert len(taken) == 3 and min(taken) > 0.1 * all_of_it and sum(taken) > 0.9 * all_of_it, (taken, all_of_it)
stiffarm.set_threads(2)
stiffarm.compliance("BT200L", joints_deg=joints)
assert len(set(os.listdir("/proc/self/task")) - before) == 2
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="threads are counted under /proc")
def test_one_thread_is_the_callers_own():
    done = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def _placed(scale):
    return stiffarm.cell(ROBOT.with_compliance(drive_urad_per_nm=scale), "A:0.3")["deflection_mm"]


@pytest.mark.parametrize("how", ["fork", "spawn"])
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_other_processes_work_after_threads_were_used(how):
    expected = [_placed(scale) for scale in (1.0, 1.5)]
    for threads in (1, None):
        stiffarm.set_threads(threads)
        assert _placed(1.0) == expected[0]
        with multiprocessing.get_context(how).Pool(1) as pool:
            assert pool.map_async(_placed, [1.0, 1.5]).get(timeout=60) == expected


@pytest.mark.filterwarnings("ignore:joint .* beyond its limits", "ignore:the angle between")
def test_the_number_of_threads_changes_no_number():
    joints = np.random.default_rng(2).uniform(-90, 90, (5001, 6))
    expected = stiffarm.compliance(ROBOT, joints_deg=joints)
    for threads in (1, 3, None):
        stiffarm.set_threads(threads)
        assert stiffarm.compliance(ROBOT, joints_deg=joints) == expected
    for bad in (0, 1025):
        with pytest.raises(StiffarmError, match="threads"):
            stiffarm.set_threads(bad)


@pytest.mark.parametrize("name", ["LICENSE-MIT", "LICENSE-APACHE"])
def test_the_licences_come_with_the_package(name):
    found = [file for file in importlib.metadata.files("stiffarm") if file.name == name]
    assert [file.read_text() for file in found] == [(Path(__file__).resolve().parents[3] / name).read_text()]


def test_an_estimated_robot_has_no_rank_in_data_frames_and_is_never_called_best():
    ranking = stiffarm.rank(tasks=["A:0.1", "B:0.5"])
    assert ranking.rows[0]["status"] == "estimated"
    frame = ranking.to_pandas()
    estimated = frame["status"] == "estimated"
    assert frame["rank"][estimated].isna().all() and frame["rank"][~estimated].min() == 1
    best = next(row["robot"] for row in ranking.rows if row["status"] != "estimated")
    assert f"best {best}" in repr(ranking)


def test_columns_have_the_same_types_whatever_they_hold():
    fits, misfits = (stiffarm.place(ROBOT, task=task).to_pandas() for task in ("A:0.3", "A:9"))
    assert list(fits.columns) == list(misfits.columns)
    for key in ("deflection_mm", "x_m", "q1_deg", "within_x0_m"):
        assert fits[key].dtype == misfits[key].dtype == np.float64, key
    assert misfits["deflection_mm"].isna().all() and "does not fit" in misfits["reason"][0]


def test_a_place_keeps_what_was_asked():
    asked = {"within_m": ((1.2, None), (0.4, 1.8)), "model": "spatial", "tool_mm": (0, 0, 200), "tool_direction": 30}
    for model in ("planar", "spatial"):
        options = asked if model == "spatial" else {"within_m": asked["within_m"]}
        best = stiffarm.place(ROBOT, task="A:0.1", **options)
        assert best.within_m == [[1.2, None], [0.4, 1.8]] and best.schema["version"] == 2
    assert best.tool_mm[:3] == [0, 0, 200] and abs(best.tool_direction_deg - 30) < 1e-9


def test_what_an_import_noted_is_a_warning():
    urdf = Path(__file__).parents[3] / "docs" / "examples" / "example_150.urdf"
    for read in (Robot, Robot.from_urdf):
        with pytest.warns(UserWarning, match="example_150.urdf: ") as caught:
            assert read(urdf).name == "Example 150"
        assert len(caught) > 1
