"""Prints the ratios of a benchmark run: ours (criterion's medians) against the peer's, and whole runs of the program."""

import json
import pathlib
import statistics
import subprocess
import sys
import time

CRITERION = pathlib.Path("target/criterion")
PROGRAM = "target/release/stiffarm"


def median_s(benchmark):
    estimates = json.loads((CRITERION / benchmark / "new" / "estimates.json").read_text())
    return estimates["median"]["point_estimate"] * 1e-9


def wall_s(*arguments, rounds=25):
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main():
    numpy_s = statistics.mean(float(value) for value in sys.argv[1:])
    print(f"\nNumPy, worst-direction map 1000 x 1000 without limits: {numpy_s * 1e3:.2f} ms, {1e-6 / numpy_s * 1e6:.0f} M points/s")
    for name in ("limits", "limits_fresh_memory", "no_limits", "limits_directed"):
        ours_s = median_s(f"map_1000x1000/{name}")
        print(f"  map, {name}: {ours_s * 1e3:.3f} ms, {1e-6 / ours_s * 1e6:.0f} M points/s, {numpy_s / ours_s:.1f} times NumPy")
    for name in ("exact", "within", "within_any_angle"):
        print(f"  place, {name}: {median_s(f'place/{name}') * 1e3:.3f} ms")
    print(f"  rank, ten robots, six tasks, one thread: {median_s('rank_ten_robots_six_tasks') * 1e3:.2f} ms")
    print(f"  Table I with boundaries, one thread: {median_s('table_1/with_boundaries') * 1e3:.1f} ms")
    for arguments in (["rank"], ["place", "BT200L", "--task", "B:0.5"], ["robots", "list"], ["study"]):
        print(f"  whole run of `stiffarm {' '.join(arguments)}`: {wall_s(*arguments) * 1e3:.1f} ms")


if __name__ == "__main__":
    main()
