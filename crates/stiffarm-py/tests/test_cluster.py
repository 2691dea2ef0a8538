"""Sweeps on a cluster: the same numbers, the same bytes, and nothing lost when something breaks. Real processes throughout."""

import contextlib
import hashlib
import json
import logging
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import dask
import matplotlib.pyplot as plt
import numpy as np
import pyarrow.parquet as pq
import pytest
import stiffarm
from distributed import Client, LocalCluster
from stiffarm import Robot, StiffarmError, cluster
from stiffarm.cluster import _question, _run

ROBOTS = ["KR 210 R2700 extra", "IRB 6650S-200", "ES200RD II", "IRB 6400 2.4-200"]
ASKED = {
    "tasks": ["A:0.3", "B:0.5", "A:9"], "force_n": [500, 1000, 1234.5], "chunk_rows": 60,
    "scenarios": cluster.spread(12, robots=4, seed=5),
}  # fmt: skip


def local(workers):
    return LocalCluster(
        n_workers=workers, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL
    )  # fmt: skip


@pytest.fixture(scope="module")
def client():
    with local(2) as made, Client(made) as connected:
        yield connected


@pytest.fixture(scope="module")
def done(client, tmp_path_factory):
    return cluster.sweep(ROBOTS, folder=tmp_path_factory.mktemp("sweep") / "done", client=client, **ASKED)


def parts(folder):
    return {path.name: path.read_bytes() for path in sorted(Path(folder).glob("part-*"))}


def listed(folder):
    """The manifest, read without the code of the package; a torn last line is none."""
    lines = (Path(folder) / "_sha256sums").read_text().split("\n")[:-1]
    return {name: digest for digest, name in (line.split("  ") for line in lines)}


def left_over(folder):
    return {path.name for path in Path(folder).iterdir() if path.suffix != ".parquet"} - {
        "_question.json", "_scenarios.npy", "_sha256sums", "_lock"
    }  # fmt: skip


def refused(match, **options):
    with pytest.raises(StiffarmError, match=match):
        cluster.sweep(**{"robots": ROBOTS, **ASKED, **options})


# Numbers


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
    robots = cluster._told_apart(ROBOTS if model == "planar" else ROBOTS[:1])
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


def test_the_order_is_that_of_rank(client, tmp_path):
    tasks = ["A:0.3", "B:9", "B:0.5"]
    found, expected = cluster.rank(tasks=tasks, client=client, folder=tmp_path / "r"), stiffarm.rank(tasks=tasks)
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


# Bytes


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

    rust = [path for name in ("stiffarm", "stiffarm-py") for path in (crates / name / "src").rglob("*") if path.is_file()]
    expected = hashlib.sha256(sums(crates, rust)).hexdigest()
    assert len(rust) > 50 and stiffarm._stiffarm.__sources__ == expected, "is the installed package that of these sources?"
    package = Path(stiffarm.__file__).parent
    assert _question._sources() == hashlib.sha256(expected.encode() + sums(package, package.rglob("*.py"))).hexdigest()


# Faults


#: Each chunk takes long enough to be interrupted.
SLOW = {"tasks": ["B:0.5", "C:0.15"], "force_n": 1000, "scenarios": cluster.spread(2500), "chunk_rows": 2500}


@pytest.fixture(scope="module")
def slow(client, tmp_path_factory):
    return parts(cluster.sweep(ROBOTS, folder=tmp_path_factory.mktemp("slow") / "s", client=client, **SLOW).folder)


def wait_for(what, seconds=30):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end, "nothing happened"
        time.sleep(0.01)


def script(folder, workers=2):
    """A caller in a process of its own."""
    text = f"""
    from stiffarm import cluster
    if __name__ == "__main__":
        cluster.sweep({ROBOTS!r}, folder={str(folder)!r}, workers={workers}, tasks=["B:0.5", "C:0.15"],
                      scenarios=cluster.spread(2500), chunk_rows=2500)
    """
    path = folder.with_suffix(".py")
    path.write_text(textwrap.dedent(text))
    return subprocess.Popen([sys.executable, str(path)], stderr=subprocess.PIPE, text=True)


@pytest.mark.parametrize("again", [3, 0])
def test_a_worker_that_dies(slow, tmp_path, again):
    """Its chunk is tried again; where it ended all the workers that may try it, the chunk is named."""
    folder, killed = tmp_path / "w", []
    failures = {"distributed.scheduler.allowed-failures": again}
    with dask.config.set(failures), local(2) as made, Client(made) as connected:
        pids = list(connected.run(os.getpid).values())

        def kill():
            with contextlib.suppress(TimeoutError):
                wait_for(lambda: len(parts(folder)) >= 1)
            os.kill(pids[0], signal.SIGKILL)
            killed.append(len(parts(folder)))

        thread = threading.Thread(target=kill)
        thread.start()
        if again:
            cluster.sweep(ROBOTS, folder=folder, client=connected, **SLOW)
        else:
            refused(r"chunk \d ended every worker.*finished parts are kept", folder=folder, client=connected, **SLOW)
        thread.join()
    assert killed[0] < len(slow), "killed too late to prove anything"
    assert parts(folder) == slow if again else parts(folder).items() < slow.items()


def test_a_caller_that_dies_and_asks_again(slow, client, tmp_path):
    folder = tmp_path / "c"
    caller = script(folder)
    wait_for(lambda: folder.is_dir() and len(parts(folder)) >= 2)
    # A second caller is refused while the first one runs.
    refused("another run is writing", folder=folder, **SLOW)
    caller.kill()
    caller.communicate()
    time.sleep(0.5)
    # A part whose digest the caller did not live to write down is computed again.
    before = {name: (folder / name).stat().st_mtime_ns for name in listed(folder) if name in parts(folder)}
    assert 1 <= len(before) < len(slow), "killed too late to prove anything"
    (folder / f"_{min(slow)}.{'0f' * 16}").write_bytes(b"half")
    cluster.sweep(ROBOTS, folder=folder, client=client, **SLOW)
    assert parts(folder) == slow and not left_over(folder)
    assert all((folder / name).stat().st_mtime_ns == when for name, when in before.items())


def test_a_script_that_its_workers_would_run_again(tmp_path):
    path = tmp_path / "script.py"
    path.write_text(f"from stiffarm import cluster\ncluster.sweep({ROBOTS!r}, folder={str(tmp_path / 'g')!r}, workers=1)\n")
    found = subprocess.run([sys.executable, str(path)], capture_output=True, text=True, timeout=30)
    assert found.returncode == 1 and found.stderr.rstrip().endswith('put the call under if __name__ == "__main__":')


def test_ctrl_c_ends_the_run_and_keeps_the_parts(slow, tmp_path):
    folder = tmp_path / "k"
    caller = script(folder)
    wait_for(lambda: folder.is_dir() and len(parts(folder)) >= 1)
    caller.send_signal(signal.SIGINT)
    assert "KeyboardInterrupt" in caller.communicate(timeout=15)[1] and not left_over(folder)
    assert parts(folder).items() <= slow.items() and len(parts(folder)) < len(slow)


def test_a_scheduler_of_the_command_line_that_dies(slow, client, tmp_path):
    folder, programs = tmp_path / "d", []

    def start(*arguments):
        command = [sys.executable, "-m", *arguments]
        programs.append(subprocess.Popen(command, stderr=subprocess.PIPE, text=True))
        return programs[-1].stderr

    try:
        told = start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        address = next(found[0] for line in told if (found := re.search(r"tcp://[\d.:]+", line)))
        refused("has no workers", folder=folder, client=address, timeout_s=0.5)
        start("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard")

        def kill():
            wait_for(lambda: len(parts(folder)) >= 1)
            programs[0].kill()

        killer = threading.Thread(target=kill)
        killer.start()
        refused("scheduler is gone; finished parts are kept", folder=folder, client=address, timeout_s=20, **SLOW)
        killer.join()
    finally:
        for program in programs:
            program.kill()
            program.communicate()
    assert 1 <= len(parts(folder)) < len(slow)
    refused("no scheduler answers", folder=folder, client=address, timeout_s=0.5, **SLOW)
    assert parts(cluster.sweep(ROBOTS, folder=folder, client=client, **SLOW).folder) == slow


def test_poisonous_rows(client, tmp_path):
    good, bad = tmp_path / "robots" / "good.toml", tmp_path / "robots" / "bad.toml"
    good.parent.mkdir()
    good.write_text(Robot(ROBOTS[0]).to_toml())
    bad.write_text("name = [")
    scenarios = cluster.spread(5)
    scenarios[1, 3], scenarios[3, 0], scenarios[4, 1] = np.nan, -1, 1e9
    found = cluster.sweep([good.parent, ROBOTS[1]], tasks="A:0.3", scenarios=scenarios, client=client, folder=tmp_path / "p")
    rows = found.to_arrow().to_pylist()
    errors = [row["error"] for row in rows]
    assert all("bad.toml" in errors[i] for i in range(0, 15, 3)) and rows[0]["robot"] == str(bad)
    assert all("factor nan of drive 4" in errors[i] for i in (4, 5)) and all("factor -1.0" in errors[i] for i in (10, 11))
    assert all("10000 urad" in errors[i] for i in (13, 14))
    assert [errors[i] for i in (1, 2, 7, 8)] == [None] * 4 and all(rows[i]["feasible"] for i in (1, 2, 7, 8))
    wins = {row["robot"]: row for row in found.wins().rows}
    assert wins[str(bad)]["errors"] == 5 and wins[str(bad)]["share"] is None
    assert wins[ROBOTS[1]]["errors"] == 3 and wins[ROBOTS[1]]["scenarios"] == 2
    order = cluster.rank([good.parent, ROBOTS[1]], tasks="A:0.3", client=client, folder=tmp_path / "o")
    assert order.rows[-1]["robot"] == str(bad) and order.rows[-1]["error"] and order.rows[-1]["rank"] is None


def test_a_full_disk(client, tmp_path):
    folder = tmp_path / "small"
    folder.mkdir()
    if os.name != "posix" or subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(folder)], capture_output=True
    ).returncode:  # fmt: skip
        pytest.skip("no file system can be mounted here")
    try:
        refused(r"cannot write .*part-\d+.*No space left on device; make room", folder=folder, client=client, chunk_rows=9)
        # The other worker may be at its chunk still.
        wait_for(lambda: not left_over(folder), seconds=5)
        kept = parts(folder)
        assert kept
        assert all(pq.read_metadata(folder / name).num_rows == 9 for name in kept)
        subprocess.run(["mount", "-o", "remount,size=16m", str(folder)], check=True)
        whole = cluster.sweep(ROBOTS, folder=folder, client=client, **{**ASKED, "chunk_rows": 9})
        assert kept.items() <= parts(folder).items() and len(whole.to_arrow()) == len(whole)
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def test_a_disk_that_fills_while_a_file_is_written(tmp_path, monkeypatch):
    def full(_):
        raise OSError(28, "No space left on device")

    path = tmp_path / "part"
    path.write_bytes(b"before")
    with monkeypatch.context() as patched, pytest.raises(StiffarmError, match="part: No space left.*finished parts are kept"):
        patched.setattr(os, "fsync", full)
        _question.write_whole(path, b"after")
    assert [each.name for each in tmp_path.iterdir()] == ["part"] and path.read_bytes() == b"before"


def test_a_file_has_its_name_only_when_it_is_complete(tmp_path, monkeypatch):
    """What a reader sees while a part is being written, and what a kill in the middle leaves."""
    seen = []
    fsync = os.fsync
    monkeypatch.setattr(os, "fsync", lambda file: (fsync(file), seen.extend(path.name for path in tmp_path.iterdir())))
    _question.write_whole(tmp_path / "part", b"whole")
    assert len(seen) == 1 and seen[0].startswith("_part.") and (tmp_path / "part").read_bytes() == b"whole"


# What makes no sense


def test_questions_that_make_no_sense(tmp_path):
    folder = tmp_path / "n"
    for match, options in (
        ("no robot", {"robots": []}), ("no task", {"tasks": []}), ("no force", {"force_n": []}),
        ("did you mean", {"robots": "KR 210 R2700 extr"}), ("task|circle", {"tasks": "Q:1"}), ("force_n", {"force_n": [1, np.nan]}),
        ("force_n", {"force_n": -1}), ("gap", {"gap": 0}), ("model", {"model": "flat"}), ("tool_mm needs", {"tool_mm": (0, 0, 100)}),
        ("shape \\(3, 5\\)", {"scenarios": np.ones((3, 5))}), ("shape \\(6,\\)", {"scenarios": np.ones(6)}),
        ("shape \\(0, 6\\)", {"scenarios": np.ones((0, 6))}), ("shape \\(2, 3, 6\\)", {"scenarios": np.ones((2, 3, 6))}),
        ("scenarios of type", {"scenarios": [["a"] * 6]}), ("no six factors", {"scenarios": np.full((2, 6), np.nan)}),
        ("no six factors", {"scenarios": np.zeros((2, 6))}), ("chunk_rows", {"chunk_rows": 0}), ("chunk_rows", {"chunk_rows": 1.5}),
        ("workers", {"workers": 0}), ("leave one", {"workers": 2, "client": "tcp://127.0.0.1:9"}),
        ("no scheduler answers at tcp://127.0.0.1:9", {"client": "tcp://127.0.0.1:9", "timeout_s": 0.3}),
        ("no scheduler answers", {"client": "what://ever", "timeout_s": 0.3}),
    ):  # fmt: skip
        refused(match, folder=folder, **options)
    for bad in ({"m": 0}, {"m": 3, "percent": 100}, {"m": 3, "percent": math.nan}, {"m": 3, "robots": 0}):
        with pytest.raises(StiffarmError):
            cluster.spread(**bad)
    with pytest.raises(StiffarmError, match="folder is missing"):
        cluster.rank(client="tcp://127.0.0.1:9")


def test_folders_that_hold_something_else(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    refused("holds something else \\(notes.txt\\)", folder=tmp_path)
    refused("cannot write into", folder=tmp_path / "notes.txt")
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]
    with pytest.raises(StiffarmError, match="holds no sweep"):
        cluster.load(tmp_path)
    other = tmp_path / "other"
    other.mkdir()
    for text in ("{", "[]", "{}", json.dumps({"format": 1})):
        (other / "_question.json").write_text(text)
        refused("cannot be read", folder=other)


def test_a_folder_that_was_tampered_with(done, tmp_path):
    folder = tmp_path / "t"
    shutil.copytree(done.folder, folder)
    np.save(folder / "_scenarios.npy", ASKED["scenarios"] * 2)
    refused("was changed", folder=folder)


@pytest.fixture(scope="module")
def small(client, tmp_path_factory):
    """Two parts, so that every byte can be tried."""
    options = {"tasks": "A:0.3", "scenarios": cluster.spread(3), "chunk_rows": 6, "client": client}
    found = cluster.sweep(ROBOTS, folder=tmp_path_factory.mktemp("small") / "s", **options)
    return found.folder, found.to_arrow()


def test_the_manifest_is_that_of_sha256sum(small):
    folder, _ = small
    expected = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}
    assert listed(folder) == {name: expected[name] for name in expected.keys() - {"_lock", "_sha256sums"}} and len(expected) == 6


def test_no_flipped_bit_goes_unnoticed(small, tmp_path):
    folder = tmp_path / "f"
    shutil.copytree(small[0], folder)
    draw = np.random.default_rng(3)
    for path in sorted(set(folder.iterdir()) - {folder / "_lock"}):
        whole = path.read_bytes()
        for bit in draw.choice(8 * len(whole), min(8 * len(whole), 150), replace=False):
            flipped = bytearray(whole)
            flipped[bit // 8] ^= 1 << bit % 8
            path.write_bytes(flipped)
            with pytest.raises(StiffarmError, match=r"_sha256sums|_question\.json|_scenarios\.npy|part-") as told:
                cluster.load(folder)
            assert str(folder) in str(told.value), (path.name, bit)
        path.write_bytes(whole)
    assert cluster.load(folder).to_arrow().equals(small[1])


def test_a_part_under_the_name_of_another_is_refused_and_computed_again(small, client, tmp_path):
    folder = tmp_path / "c"
    shutil.copytree(small[0], folder)
    first, second = (folder / name for name in sorted(parts(folder)))
    read = cluster.load(folder)
    shutil.copy(first, second)
    for call in (lambda: cluster.load(folder), read.to_arrow, read.to_pandas, read.to_polars, read.wins, read.plot):
        with pytest.raises(StiffarmError, match=f"{second.name} was changed .* ask the same with the same folder"):
            call()
    options = {"tasks": "A:0.3", "scenarios": cluster.spread(3), "chunk_rows": 6, "client": client}
    with pytest.warns(RuntimeWarning, match=f"{second.name} was changed"):
        found = cluster.sweep(ROBOTS, folder=folder, **options)
    assert found.to_arrow().equals(small[1]) and parts(folder) == parts(small[0])


def test_a_damaged_manifest_costs_no_more_than_what_it_named(small, client, tmp_path):
    folder = tmp_path / "m"
    shutil.copytree(small[0], folder)
    kept = (folder / "_sha256sums").read_bytes()
    options = {"tasks": "A:0.3", "scenarios": cluster.spread(3), "chunk_rows": 6, "client": client}
    (folder / "_sha256sums").write_bytes(kept.replace(b"  part-000000001", b"  fart-000000001"))
    with pytest.raises(StiffarmError, match="line 4 of .*_sha256sums is damaged"):
        cluster.load(folder)
    with pytest.warns(RuntimeWarning, match="line 4"):
        cluster.sweep(ROBOTS, folder=folder, **options)
    assert (folder / "_sha256sums").read_bytes() == kept
    # A killed run leaves a line without an end.
    (folder / "_sha256sums").write_bytes(kept[:-20])
    with pytest.raises(StiffarmError, match="part-000000001.* is not listed"):
        cluster.load(folder)
    cluster.sweep(ROBOTS, folder=folder, **options)
    assert (folder / "_sha256sums").read_bytes() == kept
    (folder / "_sha256sums").unlink()
    for call in (lambda: cluster.load(folder), lambda: cluster.sweep(ROBOTS, folder=folder, **options)):
        with pytest.raises(StiffarmError, match="_sha256sums is not there.*restore it from a copy"):
            call()


def test_folders_of_the_first_format_are_read_with_a_warning(small, tmp_path):
    """Made here as that format wrote them: neither sources nor manifest."""
    folder = tmp_path / "o"
    shutil.copytree(small[0], folder)
    asked = json.loads((folder / "_question.json").read_text())
    del asked["sources"], asked["fingerprint"]
    asked["format"] = 1
    fingerprint = hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()[:16]
    (folder / "_question.json").write_text(json.dumps({**asked, "fingerprint": fingerprint}))
    (folder / "_sha256sums").unlink()
    for path in folder.glob("part-*"):
        path.rename(folder / f"{path.name[:15]}{fingerprint}.parquet")
    with pytest.warns(RuntimeWarning, match="kept no digests"):
        found = cluster.load(folder)
    assert found.to_arrow().equals(small[1])
    refused(r"begun by stiffarm .* \(sources unknown\)", folder=folder)
    found.files[1].write_bytes(found.files[1].read_bytes()[:-9])
    with pytest.raises(StiffarmError, match=f"{found.files[1].name} cannot be read"):
        found.wins()


def test_folders_of_the_second_format_are_read_without_factors(small, client, tmp_path):
    """Made here as that format wrote them: no factors in the rows."""
    import pyarrow as pa

    folder = tmp_path / "o"
    shutil.copytree(small[0], folder)
    asked = json.loads((folder / "_question.json").read_text())
    del asked["fingerprint"]
    asked["format"] = 2
    fingerprint = hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()[:16]
    text = json.dumps({**asked, "fingerprint": fingerprint})
    (folder / "_question.json").write_text(text)
    sums = [(hashlib.sha256(text.encode()).hexdigest(), "_question.json")]
    if (folder / "_scenarios.npy").exists():
        sums.append((hashlib.sha256((folder / "_scenarios.npy").read_bytes()).hexdigest(), "_scenarios.npy"))
    for path in sorted(folder.glob("part-*")):
        table = pq.read_table(path)
        older = path.with_name(f"{path.name[:15]}{fingerprint}.parquet")
        path.unlink()
        pq.write_table(table.drop_columns([name for name in table.column_names if name.startswith("compliance_factor")]), older)
        sums.append((hashlib.sha256(older.read_bytes()).hexdigest(), older.name))
    (folder / "_sha256sums").write_text("".join(f"{digest}  {name}\n" for digest, name in sums))
    found = cluster.load(folder)
    assert found.is_proved and isinstance(found.to_arrow(), pa.Table)
    assert found.wins() == cluster.load(small[0]).wins()
    assert not any(name.startswith("compliance_factor") for name in found.to_arrow().column_names)
    # It is read, and not written on: its parts would differ from the others.
    with pytest.raises(StiffarmError, match="was begun by"):
        cluster.sweep(ROBOTS, folder=folder, client=client, **ASKED)
    later = json.loads((folder / "_question.json").read_text())
    (folder / "_question.json").write_text(json.dumps({**later, "format": 4}))
    with pytest.raises(StiffarmError, match="a later one; install that to read it"):
        cluster.load(folder)


def test_workers_that_do_not_see_the_folder(tmp_path):
    with pytest.raises(StiffarmError, match="does not see .* share"):
        _question.answer_chunk(str(tmp_path / "elsewhere"), "0" * 16, 0, os.getpid())


def test_what_is_not_installed_is_named(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r"pip install 'stiffarm\[cluster\]'"):
        cluster.sweep(folder=tmp_path)


def test_only_what_a_sweep_has_left_half_written_is_removed(small, client, tmp_path):
    folder = tmp_path / "u"
    shutil.copytree(small[0], folder)
    part = min(parts(folder))
    halves = [f"_{name}.{'0f' * 16}" for name in (part, "_question.json", "_scenarios.npy", "_sha256sums")]
    mine = ["_x.y.z", "_notes.tar.gz", f"_{part}.mine", f"_{part}.{'0F' * 16}", f"x_{part}.{'0f' * 16}", "_a.b.c/kept"]
    for name in halves + mine:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(b"half")
    # A folder is not what a sweep makes.
    (folder / f"_{part}.{'1f' * 16}").mkdir()
    before = parts(folder)
    options = {"tasks": "A:0.3", "scenarios": cluster.spread(3), "chunk_rows": 6, "client": client}
    assert cluster.sweep(ROBOTS, folder=folder, **options).to_arrow().equals(small[1])
    assert all((folder / name).read_bytes() == b"half" for name in mine) and (folder / f"_{part}.{'1f' * 16}").is_dir()
    assert not any((folder / name).exists() for name in halves) and parts(folder) == before
    # In a folder without a question halves are no obstacle, and what is a user's own is.
    new = tmp_path / "new"
    new.mkdir()
    (new / halves[1]).write_bytes(b"half")
    (new / "_question_mine.txt").write_text("mine")
    refused("holds something else \\(_question_mine.txt\\)", folder=new)
    (new / "_question_mine.txt").unlink()
    cluster.sweep(ROBOTS, folder=new, **options)
    assert not left_over(new)


def test_a_worker_that_dies_while_it_writes_leaves_nothing(small, tmp_path, monkeypatch):
    """The run ends well on another worker; what the dead one had begun is removed at the end, not at the next call."""
    folder, write = tmp_path / "d", _run.clear_halves
    seen = []

    def clear(where):
        if (where / "_question.json").exists():
            (where / f"_{min(parts(where))}.{'0f' * 16}").write_bytes(b"half")
        write(where)
        seen.append(left_over(where))

    monkeypatch.setattr(_run, "clear_halves", clear)
    cluster.sweep(ROBOTS, folder=folder, workers=1, tasks="A:0.3", scenarios=cluster.spread(3), chunk_rows=6)
    assert seen == [set(), set()] and parts(folder) == parts(small[0])


def test_one_zone_under_several_names_is_computed_once(client, tmp_path):
    tasks = ["circle:0.30", "A:0.3", " circle:.3", "B:0.2", "rect:0.2x0.4"]
    found = cluster.sweep(ROBOTS, tasks=tasks, client=client, folder=tmp_path / "z")
    assert found.shape == (1, 2, 1, 4) and {row["task"] for row in found.to_arrow().to_pylist()} == {"circle:0.30", "B:0.2"}


def test_robots_of_one_name_are_told_apart(client, tmp_path):
    lengths = {"X #2": 900, "X": 1000, "x": 1100}
    robots = [Robot.from_numbers(name, l2_mm=length, l3_mm=800) for name, length in lengths.items()]
    robots += [Robot.from_numbers("X", l2_mm=1200, l3_mm=800, vendor=vendor) for vendor in ("one", "other")]
    found = cluster.sweep(robots, tasks="A:0.3", client=client, folder=tmp_path / "n").to_arrow().to_pylist()
    assert [row["robot"] for row in found] == ["X #2", "X", "x", "X #3", "X #4"]
    for row, robot in zip(found, robots):
        assert row["deflection_mm"] == stiffarm.cell(robot, "A:0.3")["deflection_mm"] and row["vendor"] == (robot.vendor or None)


def test_arguments_of_other_types(client, tmp_path):
    whole = np.int64(3)
    found = cluster.sweep(
        ROBOTS, tasks="A:0.3", scenarios=cluster.spread(whole, robots=np.int32(4), seed=np.int64(2)), chunk_rows=np.int64(6),
        client=client, folder=tmp_path / "i",
    )  # fmt: skip
    assert len(found) == 12 and len(found.files) == 2
    masked = np.ma.masked_array(np.ones((2, 6)), np.eye(2, 6) > 0)
    for name, bad in (
        ("folder", 5), ("chunk_rows", "x"), ("chunk_rows", True), ("workers", 1.5), ("workers", 10**5000), ("force_n", [10**400]),
        ("scenarios", masked), ("timeout_s", "x"), ("client", 5), ("robots", 5), ("robots", [None]), ("tasks", [5]), ("tasks", 5),
    ):  # fmt: skip
        refused(name, **{"folder": tmp_path / "b", name: bad})
    for bad in ({"m": "x"}, {"m": 10**30}, {"m": 1.5}, {"m": 3, "percent": "x"}, {"m": 3, "seed": -1}, {"m": 3, "robots": "x"}):
        with pytest.raises(StiffarmError, match=next(reversed(bad))):
            cluster.spread(**bad)
    with pytest.raises(StiffarmError, match="folder=5"):
        cluster.load(5)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read_is_named(small, tmp_path):
    folder = tmp_path / "p"
    shutil.copytree(small[0], folder)
    for path in (folder / "_question.json", folder / "_sha256sums", folder / max(parts(folder))):
        path.chmod(0)
        with pytest.raises(StiffarmError, match=path.name):
            cluster.load(folder)
        path.chmod(0o644)


def test_files_that_are_none_are_named(small, tmp_path):
    for name in ("_question.json", "_sha256sums", "_scenarios.npy", max(parts(small[0]))):
        folder = tmp_path / name
        shutil.copytree(small[0], folder)
        (folder / name).unlink()
        (folder / name).mkdir()
        with pytest.raises(StiffarmError, match=name if not name.startswith("part") else "chunks are missing"):
            cluster.load(folder)


# Who wins


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
    told = {row["robot"]: (row["scenarios"], row["errors"], row["share"]) for row in found.rows}
    assert told == {names[0]: (4, 2, 1.0), names[1]: (4, 0, 0.0)}


def test_a_number_of_scenarios_draws_the_drives_as_every_interval_does(client, tmp_path):
    """The interval of a posture comes from 2000 draws: with the factors that a sweep has, posture by posture, it is the same."""
    names, options = ["KR 210 R2700 extra", "IRB 6650S-200"], {"model": "spatial", "chunk_rows": 3}
    made = cluster.sweep(names, tasks="circle:0.1", scenarios=2, client=client, folder=tmp_path / "d", **options)
    question, rows = _question.read_question(made.folder), made.to_arrow().to_pylist()
    asked = {"joints_deg": [10.0, -70.0, 100.0, 20.0, 40.0, 0.0], "force_n": [300.0, -500.0, 800.0]}
    _, drawn = cluster._drawn(cluster._told_apart(names), {"model": "spatial"}, 2000)
    for r, name in enumerate(names):
        mine = [[row[f"compliance_factor_{drive}"] for drive in range(1, 7)] for row in rows if row["robot"] == name]
        assert np.array_equal(mine, drawn[:2, r])
        nominal = Robot.from_toml(question.robots[r]["toml"])
        told = stiffarm.compliance(name, stiffness="prior", **asked).to_dict()
        assert nominal.drive_urad_per_nm == pytest.approx(told["drive_urad_per_nm"], rel=1e-12)
        moved = []
        for factors in drawn[:, r]:
            arm = nominal.with_compliance(drive_urad_per_nm=nominal.drive_urad_per_nm * factors)
            moved.append(np.linalg.norm(stiffarm.compliance(arm, **asked).to_dict()["deflection_mm"]))
        fifth, last = np.sort(moved)[[100, 1899]]
        assert (fifth, last) == pytest.approx((told["deflection_mm_p05"], told["deflection_mm_p95"]), rel=1e-9)


def test_a_robot_of_which_nothing_is_known_has_no_draws(client, tmp_path):
    planar = Robot.from_numbers("planar", l2_mm=1150, l3_mm=1000)
    options = {"tasks": "A:0.3", "scenarios": 2, "client": client}
    with pytest.raises(StiffarmError, match="nothing says how far the drives of planar may be off"):
        cluster.sweep(planar, folder=tmp_path / "n", **options)
    with pytest.raises(StiffarmError, match="nothing says .* of KR 210 R2700 extra .* stiffness='prior'"):
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
    told = [line for line in wins.summary if "holds 1.2 mm in" in line]
    assert told and all("% of them (95 % confidence" in line for line in told)
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
