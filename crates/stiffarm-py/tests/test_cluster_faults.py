"""Sweeps on a cluster: nothing is lost when a worker, a caller, a scheduler or a disk fails. Real processes throughout."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import textwrap
import threading
import time

import dask
import numpy as np
import pyarrow.parquet as pq
import pytest
from distributed import Client
from stiffarm import Robot, StiffarmError, cluster
from stiffarm.cluster import _question
from sweeps import ASKED, ROBOTS, left_over, listed, local, parts, refused


#: Each chunk takes long enough to be interrupted.
SLOW = {"tasks": ["B:0.5", "C:0.15"], "force_n": 1000, "scenarios": cluster.spread(400), "chunk_rows": 400}


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
                      scenarios=cluster.spread(400), chunk_rows=400)
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
    wait_for(lambda: (folder / "_sha256sums").exists() and any(name.startswith("part-") for name in listed(folder)))
    # It is held still, so that what it had written down when it died does not depend on how busy the machine is.
    caller.send_signal(signal.SIGSTOP)
    # A second caller is refused while the first one has the folder.
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
        lines = start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        address = next(found[0] for line in lines if (found := re.search(r"tcp://[\d.:]+", line)))
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
