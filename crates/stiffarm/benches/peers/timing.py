"""One thread, the median of some rounds, one line of JSON. Import it before NumPy, which reads it once."""

import os

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import json
import statistics
import time
from collections.abc import Callable


def report(name: str, version: str, count: int, work: Callable[[], object], rounds: int) -> None:
    work()
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    print(json.dumps({"name": name, "version": version, "per_second": count / statistics.median(times)}))
