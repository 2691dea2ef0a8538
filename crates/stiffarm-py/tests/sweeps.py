"""What the tests of sweeps share: a small sweep, and looks into its folder."""

import logging
from pathlib import Path

import pytest
from distributed import Client, LocalCluster
from stiffarm import StiffarmError, cluster


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


@pytest.fixture(scope="module")
def small(client, tmp_path_factory):
    """Two parts, so that every byte can be tried."""
    options = {"tasks": "A:0.3", "scenarios": cluster.spread(3), "chunk_rows": 6, "client": client}
    found = cluster.sweep(ROBOTS, folder=tmp_path_factory.mktemp("small") / "s", **options)
    return found.folder, found.to_arrow()
