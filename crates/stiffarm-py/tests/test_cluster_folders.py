"""Sweeps on a cluster: questions that make no sense, and folders that were damaged or hold something else."""

import hashlib
import json
import math
import os
import shutil
import sys

import numpy as np
import pyarrow.parquet as pq
import pytest
import stiffarm
from stiffarm import Robot, StiffarmError, cluster
from stiffarm.cluster import _question, _run
from sweeps import ASKED, ROBOTS, left_over, listed, parts, refused


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
            with pytest.raises(StiffarmError, match=r"_sha256sums|_question\.json|_scenarios\.npy|part-") as error:
                cluster.load(folder)
            assert str(folder) in str(error.value), (path.name, bit)
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
