"""How many rows a second `stiffarm.cluster` computes, what a chunk costs besides, and how large its file is.

``python benches/scale.py`` prints one JSON line a number, and takes some two minutes; docs/scale.md tells what follows.
Medians of rounds that take turns, so that other work on the machine slows all of them alike: trust ratios more than rates.
"""

import json
import logging
import os
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import stiffarm
from distributed import Client, LocalCluster
from stiffarm import cluster

ROUNDS = 3
POSTURES, BATCHES = 200_000, 4


def evaluate(seed: int) -> int:
    """Compliances of postures that are drawn where they are used."""
    stiffarm.set_threads(1)
    joints = np.random.default_rng(seed).uniform(-90, 90, (POSTURES, 6))
    return len(stiffarm.compliance("KR 210 R2700 extra", joints_deg=joints).worst_um_per_n)


def nothing(number: int) -> int:
    return number


def tell(name: str, value: float, unit: str, **more: object) -> None:
    print(json.dumps({"name": name, "value": float(f"{value:.3g}"), "unit": unit, **more}), flush=True)


class Bench:
    def __init__(self, kept: Path) -> None:
        self.kept = kept
        self.clients: dict[int, Client] = {}

    def sweep(self, workers: int, **options: object) -> tuple[float, cluster.Sweep]:
        folder = self.kept / "sweep"
        shutil.rmtree(folder, ignore_errors=True)
        start = time.perf_counter()
        found = cluster.sweep(folder=folder, client=self.clients[workers], **options)  # type: ignore[arg-type]
        return time.perf_counter() - start, found

    def postures(self, workers: int) -> float:
        client = self.clients[workers]
        start = time.perf_counter()
        client.gather(client.map(evaluate, range(BATCHES), pure=False))
        return BATCHES * POSTURES / (time.perf_counter() - start)

    def scheduled(self, workers: int, tasks: int = 2000) -> float:
        """Seconds that the scheduler takes for a task that does nothing."""
        client = self.clients[workers]
        start = time.perf_counter()
        client.gather(client.map(nothing, range(tasks), pure=False))
        return (time.perf_counter() - start) / tasks


def main() -> None:
    with tempfile.TemporaryDirectory(prefix="scale-", dir=sys.argv[1] if len(sys.argv) > 1 else None) as kept:
        bench = Bench(Path(kept))
        made = [
            LocalCluster(n_workers=n, threads_per_worker=1, dashboard_address="127.0.0.1:0", silence_logs=logging.ERROR)
            for n in (1, 2)
        ]
        try:
            bench.clients = {n: Client(each) for n, each in zip((1, 2), made)}
            measure(bench)
        finally:
            for each in [*bench.clients.values(), *made]:
                each.close()


def measure(bench: Bench) -> None:
    tell("load before", os.getloadavg()[0], "processes", cores=os.cpu_count())
    planar = {"robots": "paper", "tasks": "B:0.5", "scenarios": cluster.spread(1500, robots=10), "chunk_rows": 2500}
    # Six tasks and one force share each robot of a scenario, which takes as long to make as to place.
    shared = {**planar, "tasks": stiffarm._verbs.PAPER_TASKS, "scenarios": cluster.spread(250, robots=10)}
    spatial = {
        "robots": ["KR 210 R2700 extra", "IRB 6650S-200"], "tasks": "B:0.5", "model": "spatial",
        "scenarios": cluster.spread(4, robots=2), "chunk_rows": 2,
    }  # fmt: skip
    # The same rows in many chunks and in few: the difference is what chunks cost.
    small = {**planar, "scenarios": cluster.spread(500, robots=10), "chunk_rows": 25}
    large = {**small, "chunk_rows": 2500}
    rates: dict[tuple[str, int], list[float]] = {}
    for workers in (1, 2):
        bench.sweep(workers, **large)
        bench.postures(workers)
    for _ in range(ROUNDS):
        for workers in (1, 2):
            for name, options in (("planar", planar), ("planar, six tasks", shared), ("spatial", spatial)):
                took, found = bench.sweep(workers, **options)
                rates.setdefault((name, workers), []).append(len(found) / took)
            rates.setdefault(("compliance", workers), []).append(bench.postures(workers))
            rates.setdefault(("scheduled", workers), []).append(1e3 * bench.scheduled(workers))
            few, many = bench.sweep(workers, **large)[0], bench.sweep(workers, **small)[0]
            rates.setdefault(("chunk", workers), []).append(1e3 * (many - few) / (200 - 2))
    units = {"scheduled": "ms/task", "chunk": "ms/chunk", "compliance": "evaluations/s"}
    for (name, workers), values in rates.items():
        tell(name, statistics.median(values), units.get(name, "placements/s"), workers=workers, all=[round(v, 3) for v in values])
    for name in ("planar", "planar, six tasks", "spatial", "compliance"):
        ratios = [two / one for one, two in zip(rates[name, 1], rates[name, 2])]
        tell(f"{name}: two workers against one", statistics.median(ratios), "ratio")
    for rows in (20, 50, 200, 2500, 20_000):
        _, found = bench.sweep(2, **{**planar, "scenarios": cluster.spread(max(rows // 10, 1), robots=10), "chunk_rows": rows})
        tell("size of a row", found.files[0].stat().st_size / len(found), "byte/row", model="planar", chunk_rows=rows)
    for rows in (2, 20, 50):
        few = {**spatial, "scenarios": cluster.spread(rows // 2, robots=2), "chunk_rows": rows}
        _, found = bench.sweep(2, **few)
        tell("size of a row", found.files[0].stat().st_size / len(found), "byte/row", model="spatial", chunk_rows=rows)
    tell("load after", os.getloadavg()[0], "processes")


if __name__ == "__main__":
    main()
